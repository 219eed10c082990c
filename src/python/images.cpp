// SPDX-License-Identifier: BSD-3-Clause
#include "python/images.h"

#include <OpenImageIO/oiioversion.h>
#include <OpenImageIO/strutil.h>

#include "imagebuf/pixels/has_pixels.h"
#include "imagebuf/pixels/utf8.h"
#include "python/function.h"
#include "python/types.h"

namespace tonetool::python {

namespace {

const char kWantedImage[] = "an OpenImageIO.ImageBuf or an array of height x width, or of height x "
                            "width x 1, 3 or 4 channels (grey; R, G, B; R, G, B, A)";
const char kWantedNumbers[] = "float32, float16 or float64 (linear), uint8 or uint16 "
                              "(sRGB-encoded, as in files)";

std::string described(const py::array& array) {
    const std::string type = py::str(array.dtype());
    return std::string("is a ") +
           (array.attr("dtype").attr("isnative").cast<bool>() ? "" : "byte-swapped ") + type +
           " array of shape " + std::string(py::str(array.attr("shape")));
}

std::string& reason() {
    static std::string text;
    return text;
}

// An ImageBuf of a module that is unknown here.
[[noreturn]] void refuse_foreign(const std::string& where) {
    throw py::type_error(where + " is an ImageBuf that tonetool does not know, for " + reason() +
                         "; give its pixels as an array: image.get_pixels(\"float\")");
}

bool is_foreign_imagebuf(const py::object& object) {
    const py::type type = py::type::of(object);
    const std::string name = py::str(type.attr("__name__"));
    const std::string module = py::str(type.attr("__module__"));
    return name == "ImageBuf" && module.compare(0, 11, "OpenImageIO") == 0;
}

// What OpenImageIO calls the numbers of an array that has those of an image; unknown: it has not.
OIIO::TypeDesc type_of(const py::array& array) {
    const py::dtype type = array.dtype();
    if (!type.attr("isnative").cast<bool>() || py::hasattr(array, "mask"))
        return OIIO::TypeUnknown;
    // Of Python: pybind11 before 2.12 does not know where numpy 2 keeps it.
    const auto bytes = type.attr("itemsize").cast<py::ssize_t>();
    switch (type.kind()) {
    case 'f':
        return bytes == 2   ? OIIO::TypeHalf
               : bytes == 4 ? OIIO::TypeFloat
               : bytes == 8 ? OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE)
                            : OIIO::TypeUnknown;
    case 'u':
        return bytes == 1 ? OIIO::TypeUInt8 : bytes == 2 ? OIIO::TypeUInt16 : OIIO::TypeUnknown;
    default:
        return OIIO::TypeUnknown;
    }
}

// Whether channels come first, as PyTorch has them.
std::string hint_of_order(const py::array& array) {
    const py::ssize_t first = array.shape(0);
    if (first == 1 || first == 3 || first == 4)
        return "; channels come last: numpy.moveaxis(array, 0, -1)";
    return "; tonetool.image(array, channels=[...]) gives others their names";
}

void check_shape(const py::array& array, const std::string& where, Channels channels) {
    const auto refuse = [&](const std::string& why) {
        throw py::value_error(where + " " + described(array) + ": must be " + kWantedImage + why);
    };
    if (array.ndim() != 2 && array.ndim() != 3)
        refuse("");
    if (array.size() == 0)
        refuse(", not empty");
    if (array.size() > INT32_MAX)
        refuse(", below 2^31 values");
    const py::ssize_t count = array.ndim() == 3 ? array.shape(2) : 1;
    if (channels == Channels::Plain && count != 1 && count != 3 && count != 4)
        refuse(hint_of_order(array));
}

// The same numbers one after another; 64 bits become 32, in which all is computed.
py::array packed(const py::array& array, OIIO::TypeDesc& type) {
    const py::module_ numpy = py::module_::import("numpy");
    if (type != OIIO::TypeDesc::DOUBLE)
        return numpy.attr("ascontiguousarray")(array);
    type = OIIO::TypeFloat;
    const py::object beyond_is_inf = numpy.attr("errstate")(py::arg("over") = "ignore");
    beyond_is_inf.attr("__enter__")();
    const py::array floats = numpy.attr("ascontiguousarray")(array, "float32");
    beyond_is_inf.attr("__exit__")(py::none(), py::none(), py::none());
    return floats;
}

// An array of the pixels of `image`, which the array keeps.
py::object array_of(std::unique_ptr<OIIO::ImageBuf> image, bool channel_axis) {
    const OIIO::ImageSpec& spec = image->spec();
    std::vector<py::ssize_t> shape = {spec.height, spec.width};
    if (channel_axis || spec.nchannels != 1)
        shape.push_back(spec.nchannels);
    auto* pixels = static_cast<float*>(image->localpixels());
    const py::capsule owner(image.get(), [](void* p) { delete static_cast<OIIO::ImageBuf*>(p); });
    (void)image.release();
    return py::array_t<float>(shape, pixels, owner);
}

} // namespace

InputImage::InputImage(const py::object& object, const std::string& where, Channels channels)
    : m_object(object) {
    if (py::isinstance<OIIO::ImageBuf>(object))
        m_image = object.cast<const OIIO::ImageBuf*>();
    else if (py::isinstance<py::array>(object))
        look_at(py::array(object), where, channels);
    else if (!knows_imagebuf() && is_foreign_imagebuf(object))
        refuse_foreign(where);
    else
        wrong_type(where, object,
                   std::string(kWantedImage) +
                       (py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__")
                            ? "; tonetool.image(name) is that of a file"
                        : py::hasattr(object, "__array__") || py::isinstance<py::list>(object)
                            ? "; numpy.asarray(x) makes an array of it"
                            : ""));
}

void InputImage::look_at(const py::array& array, const std::string& where, Channels channels) {
    OIIO::TypeDesc type = type_of(array);
    if (type == OIIO::TypeUnknown) {
        const bool masked = py::hasattr(array, "mask");
        throw py::type_error(
            where + " " + described(array) + ": must be " +
            (masked ? "without a mask, which images do not have; fill it" : kWantedNumbers));
    }
    check_shape(array, where, channels);
    const py::array numbers = packed(array, type);
    m_object = numbers;
    m_dimensions = int(array.ndim());
    OIIO::ImageSpec spec(int(array.shape(1)), int(array.shape(0)),
                         m_dimensions == 3 ? int(array.shape(2)) : 1, type);
    if (!type.is_floating_point())
        spec.attribute("oiio:ColorSpace", "sRGB");
    m_view = OIIO::ImageBuf(spec, const_cast<void*>(numbers.data()));
}

py::object to_python(OIIO::ImageBuf&& image, OutputKind kind) {
    if (knows_imagebuf() && (!kind.array || image.deep()))
        return py::cast(std::move(image));
    if (image.deep())
        throw Refused("a deep image is no array, and there is no ImageBuf to hand it back as: " +
                      reason());
    const bool plain = image.localpixels() && image.spec().format == OIIO::TypeFloat;
    auto owned =
        std::make_unique<OIIO::ImageBuf>(plain ? std::move(image) : image.copy(OIIO::TypeFloat));
    return array_of(std::move(owned), kind.keep_channel_axis);
}

void check_read(const OIIO::ImageBuf& image, const std::string& function) {
    const bool there = image.initialized() && image.spec().nchannels > 0;
    if (there && !image.has_error() && has_pixels(image))
        return;
    const std::string why = image.geterror();
    throw Refused(function + ": " + with_name(image, why.empty() ? "holds no pixels" : why));
}

std::string with_path(const std::string& path, const std::string& why) {
    const std::string text = why.empty() ? "cannot be read" : why;
    return text.find(path) != std::string::npos ? text : "\"" + path + "\": " + text;
}

OIIO::ImageBuf read_here(const OIIO::ImageBuf& image, const std::string& function) {
    check_read(image, function);
    if (!is_file_to_read(image))
        return image.copy(OIIO::TypeUnknown);
    // An ImageCache does not tell of pixels that are missing.
    try {
        return read_whole(image, image.spec().format);
    } catch (const Refusal& refusal) {
        throw Refused(function + ": " + refusal.what());
    }
}

OIIO::ImageBuf named_image(const InputImage& image, const std::vector<std::string>& channels,
                           const std::string& where) {
    OIIO::ImageBuf copy = read_here(image.buf(), "image");
    if (!channels.empty() && int(channels.size()) != copy.nchannels())
        throw py::value_error(OIIO::Strutil::fmt::format(
            "{} has {} names ({}): must be one for each of the {} channels", where, channels.size(),
            valid_utf8(OIIO::Strutil::join(channels, ", ")), copy.nchannels()));
    if (!channels.empty())
        copy.specmod().channelnames = channels;
    copy.specmod().alpha_channel = -1;
    for (int c = 0; c < copy.nchannels(); ++c)
        if (copy.spec().channelnames[size_t(c)] == "A")
            copy.specmod().alpha_channel = c;
    return copy;
}

namespace {

// Empty if the module's types are those of this one.
std::string unfit(const py::module_& module) {
    const std::string version = py::str(module.attr("VERSION_STRING"));
    const std::string minor =
        OIIO::Strutil::fmt::format("{}.{}.", OIIO_VERSION_MAJOR, OIIO_VERSION_MINOR);
    if (version.compare(0, minor.size(), minor) != 0)
        return "the OpenImageIO module is " + version + ", tonetool was built with " +
               OIIO_VERSION_STRING;
    if (!knows_imagebuf())
        return "the OpenImageIO module was built with another pybind11 or compiler than tonetool";
    return "";
}

} // namespace

void find_openimageio() {
    try {
        reason() = unfit(py::module_::import("OpenImageIO"));
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_Exception))
            throw;
        reason() = "the OpenImageIO module cannot be imported (" +
                   valid_utf8(py::str(error.value())) + ")";
    }
}

bool knows_imagebuf() {
    return py::detail::get_type_info(typeid(OIIO::ImageBuf), false) != nullptr;
}

const std::string& why_no_imagebuf() {
    return reason();
}

} // namespace tonetool::python
