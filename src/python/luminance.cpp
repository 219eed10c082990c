// SPDX-License-Identifier: BSD-3-Clause
// Luminance statistics and exposure.
#include "tonetool/luminance.h"

#include "python/compare.h"
#include "python/families.h"
#include "python/results.h"

namespace tonetool::python {

namespace {

const std::string kLuminanceSource =
    "Luminance of Rec.709 (ITU-R BT.709): 0.2126 R + 0.7152 G + 0.0722 B.";

struct Pixels : IgnoreOptions {
    PixelOptions pixels;
};
using LuminanceCall = On<Pixels>;

Fields<LuminanceCall> luminance_fields() {
    return {field<LuminanceCall>("pixels", &LuminanceCall::pixels, "Layer and colour space."),
            roi_field<LuminanceCall>(), threads_field<LuminanceCall>()};
}

Fields<LuminanceCall> stats_fields() {
    return joined<LuminanceCall>({luminance_fields(), ignore_fields<LuminanceCall>()});
}

py::object stats(std::vector<py::object>& images, const LuminanceCall& options) {
    const InputImage image(images[0], "luminance_stats: image");
    LuminanceStats found;
    run_or_raise("luminance_stats", [&](std::string& error) {
        return ToneAlgo::luminance_stats(found, image.buf(), error, options.pixels, options.roi,
                                         options.nthreads, options);
    });
    return py::cast(found);
}

py::object exposure(std::vector<py::object>& arguments, const LuminanceCall& options) {
    const InputImage image(arguments[0], "exposure: image");
    const double stops = to_double(arguments[1], "exposure: stops");
    OIIO::ImageBuf result = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::exposure(dst, image.buf(), stops, options.pixels, options.roi,
                                  options.nthreads);
    });
    return to_python(std::move(result), OutputKind::picture(image));
}

void add_stats(Module& module) {
    using S = LuminanceStats;
    ResultClass<S> result(module, "LuminanceStats",
                          "Luminance over the finite pixels of an image.");
    visit_luminance(visitor(result));
    visit_source<S>(visitor(result));
    result.finish();
}

} // namespace

void add_luminance(Module& module) {
    add_stats(module);
    const Parameter image =
        image_parameter("image", "Needs R, G, B; others are ignored or carried.");
    define(
        module,
        Description{"luminance_stats",
                    "Measure the luminance of an image.",
                    {image},
                    "LuminanceStats",
                    "The figures.",
                    "Shapes: height x width x channels, R, G, B first, or an ImageBuf. Units: that "
                    "of the image, in linear Rec.709. Alpha: ignored.\nNaN, Inf: such pixels are "
                    "counted and left out.",
                    "No colour, deep images, no finite pixel, an unreadable file.",
                    kLuminanceSource},
        stats_fields(), stats);
    define(
        module,
        Description{"exposure",
                    "Multiply the colour of an image by 2^stops.",
                    {image, {"stops", "float", "-126 to 126.", ""}},
                    "Image",
                    "The picture; an array if the image is one.",
                    "Shapes: those of the image. Units: stops. Alpha and other channels: carried.\n"
                    "NaN, Inf: such pixels stay as they are.",
                    "No colour, a display-encoded image, deep images, stops out of range.",
                    kLuminanceSource},
        luminance_fields(), exposure);
}

} // namespace tonetool::python
