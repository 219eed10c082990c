// SPDX-License-Identifier: BSD-3-Clause
// Writing files so that a failed run never harms what was there.
#include "tonetool/write.h"

#include "python/families.h"

namespace tonetool::python {

namespace {

const std::string kWriteSource = "POSIX rename().";
const std::string kWriteNotes =
    "The bytes go to a temporary file beside the target, are flushed to the "
    "disk and renamed, so that "
    "the target is either the old file or the whole new one.";
const Parameter kFilename = {"filename", "str | os.PathLike[str]", "The target.", ""};
const std::string kErrors = "A file that cannot be written, an unknown format; then nothing has "
                            "changed on disk.";

struct WriteOptions {
    std::string format, compression;
};

Fields<WriteOptions> write_fields() {
    using O = WriteOptions;
    return {field<O>("format", &O::format,
                     "Data type of the file (\"half\", \"uint8\", ...); \"\": that of the image."),
            field<O>("compression", &O::compression,
                     "As OpenImageIO names it (\"zip\", \"dwaa:45\", ...); \"\": the image's.")};
}

OutputImage output_of(const InputImage& image, const WriteOptions& options,
                      const std::string& where) {
    OutputImage output;
    output.pixels = &image.buf();
    output.spec = image.buf().spec();
    if (!options.format.empty()) {
        const OIIO::TypeDesc type(options.format);
        if (type == OIIO::TypeUnknown)
            throw py::value_error(where + ": format is \"" + options.format +
                                  "\": must be the name of a data type (half, float, uint8, ...)");
        output.spec.set_format(type);
        output.spec.channelformats.clear();
    }
    if (!options.compression.empty())
        output.spec.attribute("compression", options.compression);
    return output;
}

py::object write_images(std::vector<py::object>& arguments, const WriteOptions& options) {
    std::vector<std::unique_ptr<InputImage>> images;
    std::vector<OutputImage> outputs;
    for (const py::object& object :
         to_items(arguments[0], "write_images: images", "Sequence[Image]")) {
        const std::string where = "write_images: images[" + std::to_string(images.size()) + "]";
        images.push_back(std::make_unique<InputImage>(object, where));
        outputs.push_back(output_of(*images.back(), options, "write_images"));
    }
    const std::string name = to_text(arguments[1], "write_images: filename");
    run_or_raise("write_images",
                 [&](std::string& error) { return tonetool::write_images(outputs, name, error); });
    return py::none();
}

py::object write_image(std::vector<py::object>& arguments, const WriteOptions& options) {
    const InputImage image(arguments[0], "write_image: image");
    const OutputImage output = output_of(image, options, "write_image");
    const std::string name = to_text(arguments[1], "write_image: filename");
    run_or_raise("write_image",
                 [&](std::string& error) { return tonetool::write_images({output}, name, error); });
    return py::none();
}

py::object write_bytes(std::vector<py::object>& arguments) {
    if (!py::isinstance<py::bytes>(arguments[0]))
        wrong_type("write_bytes: data", arguments[0], "bytes");
    const auto data = arguments[0].cast<std::string>();
    const std::string name = to_text(arguments[1], "write_bytes: filename");
    run_or_raise("write_bytes",
                 [&](std::string& error) { return tonetool::write_bytes(data, name, error); });
    return py::none();
}

void add_removals(Module& module) {
    define(module,
           Description{"remove_abandoned_outputs",
                       "Remove what killed processes have left of writes to these files.",
                       {{"filenames", "Sequence[str]", "Files that were to be written.", ""}},
                       "None",
                       "Nothing.",
                       "What a process still writes stays.",
                       "Never.",
                       kWriteSource},
           [](std::vector<py::object>& arguments) {
               tonetool::remove_abandoned_outputs(Python<std::vector<std::string>>::from(
                   arguments[0], "remove_abandoned_outputs: filenames"));
               return py::none();
           });
    define(
        module,
        Description{"remove_unfinished_outputs",
                    "Remove the temporary files of writes now under way, before the process ends.",
                    {},
                    "None",
                    "Nothing.",
                    "Other threads' writes fail then.",
                    "Never.",
                    kWriteSource},
        [](std::vector<py::object>&) {
            tonetool::remove_unfinished_outputs();
            return py::none();
        });
}

} // namespace

void add_write(Module& module) {
    const std::string values =
        "Shapes: those of the images. Units, NaN, alpha: values are written as "
        "they are, integers clamped and rounded. ";
    define(module,
           Description{"write_image",
                       "Write an image to a file; the format is that of the extension.",
                       {image_parameter("image", "Any image."), kFilename},
                       "None",
                       "Nothing.",
                       values + kWriteNotes,
                       kErrors,
                       kWriteSource},
           write_fields(), write_image);
    define(module,
           Description{"write_images",
                       "Write several images as subimages of one file.",
                       {{"images", "Sequence[Image]", "One each.", ""}, kFilename},
                       "None",
                       "Nothing.",
                       values + kWriteNotes,
                       kErrors,
                       kWriteSource},
           write_fields(), write_images);
    define(module,
           Description{"write_bytes",
                       "Write any bytes to a file.",
                       {{"data", "bytes", "The whole file.", ""}, kFilename},
                       "None",
                       "Nothing.",
                       kWriteNotes,
                       kErrors,
                       kWriteSource},
           write_bytes);
    add_removals(module);
}

} // namespace tonetool::python
