// SPDX-License-Identifier: BSD-3-Clause
// Making maps visible.
#include "tonetool/display.h"

#include "python/families.h"

namespace tonetool::python {

namespace {

struct Channel {
    int channel = 0;
};
using ColormapCall = On<Channel>;
struct Nothing {};
using EncodeOptions = On<Nothing>;

const std::string kDisplaySource =
    "OpenImageIO's colour maps (magma, viridis and inferno: S. van der Walt, "
    "N. Smith, matplotlib; turbo: A. Mikhailov); IEC 61966-2-1 (sRGB).";

py::object color_map(std::vector<py::object>& arguments, const ColormapCall& options) {
    const InputImage image(arguments[0], "color_map: image");
    const bool named = py::isinstance<py::str>(arguments[1]);
    const std::string name = named ? arguments[1].cast<std::string>() : "";
    const std::vector<float> triples =
        named ? std::vector<float>()
              : Python<std::vector<float>>::from(arguments[1], "color_map: map");
    OIIO::ImageBuf result = computed([&](OIIO::ImageBuf& dst) {
        return named ? ToneAlgo::color_map(dst, image.buf(), name, options.channel, options.roi,
                                           options.nthreads)
                     : ToneAlgo::color_map(dst, image.buf(), triples, options.channel, options.roi,
                                           options.nthreads);
    });
    return to_python(std::move(result), OutputKind::picture(image));
}

py::object encode_srgb(std::vector<py::object>& arguments, const EncodeOptions& options) {
    const InputImage image(arguments[0], "encode_srgb: image");
    OIIO::ImageBuf result = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::encode_srgb(dst, image.buf(), options.roi, options.nthreads);
    });
    return to_python(std::move(result), OutputKind::picture(image));
}

} // namespace

void add_display(Module& module) {
    using M = ColormapCall;
    using E = EncodeOptions;
    define(
        module,
        Description{
            "color_map",
            "False colours for a screen, for maps from 0 to 1.",
            {image_parameter("image", "A map, or any image."),
             {"map", "str | Sequence[float]",
              "One of color_maps(), or two or more evenly spaced R, G, B in one list.", ""}},
            "Image",
            "R, G, B, sRGB-encoded; an array if the image is one.",
            "Shapes: height x width (x channels) to height x width x 3. Units: 0 to 1, "
            "values beyond are clamped; the result is for a screen.\nNaN: 0. Alpha: "
            "ignored.",
            "An unknown map, no such channel, deep images.",
            kDisplaySource},
        Fields<M>{field<M>("channel", &M::channel, "Which; -1: the luminance of the first three."),
                  roi_field<M>(), threads_field<M>()},
        color_map);
    define_names(module, "color_maps", "Names of the colour maps.", kDisplaySource,
                 ToneAlgo::color_maps);
    define(module,
           Description{
               "encode_srgb",
               "sRGB-encode linear Rec.709, for a screen.",
               {image_parameter("image", "Linear.")},
               "Image",
               "The picture; an array if the image is one.",
               "Shapes: those of the image. Units: clamped to 0 to 1. Alpha: carried.\nNaN: 0.",
               "Deep images, volumes, an image that is sRGB-encoded already.",
               kDisplaySource},
           Fields<E>{roi_field<E>(), threads_field<E>()}, encode_srgb);
}

} // namespace tonetool::python
