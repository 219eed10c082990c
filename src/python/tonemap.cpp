// SPDX-License-Identifier: BSD-3-Clause
// Tone mapping and calibration.
#include "tonetool/tonemap.h"

#include "imagebuf/options/tone_options.h"
#include "python/families.h"
#include "python/results.h"

namespace tonetool::python {

namespace {

const std::string kTonemapSource =
    "M. Pettineo, \"A Closer Look at Tone Mapping\", 2010; the sources that "
    "tone_curves() names for each curve; OpenColorIO 2.";

using MapOptions = On<TonemapOptions>;
struct Calibration : CalibrationOptions {
    PixelOptions pixels;
};
using CalibrateOptions = On<Calibration>;
using TonemapObject = Imaged<TonemapSummary>;
using CalibrateObject = Imaged<CalibrationSummary>;

Fields<MapOptions> map_fields() {
    using O = MapOptions;
    return joined<O>(
        {{field<O>("curve", &O::curve, "Tone curve; None: aces."),
          field<O>("view", &O::view,
                   "A view of an OpenColorIO configuration instead of the curve."),
          field<O>("calibration", &O::calibration, "How the exposure is found; None: as it is."),
          field<O>("pixels", &O::pixels, "Layer and colour space.")},
         described<O, TonemapOptions>(),
         {roi_field<O>(), threads_field<O>()}});
}

Fields<CalibrateOptions> calibrate_fields() {
    using O = CalibrateOptions;
    Fields<O> fields;
    for (const Field<CalibrationOptions>& row : table_of<CalibrationOptions>().fields)
        fields.push_back({row.name, row.type, row.initial, row.text, row.set});
    return joined<O>({fields,
                      {field<O>("show", &O::show,
                                ("\"\": the picture; \"mean\", \"key\", \"exposure\": " +
                                 calibration_parts_text() + ".")
                                    .c_str()),
                       field<O>("pixels", &O::pixels, "Layer and colour space."), roi_field<O>(),
                       threads_field<O>()}});
}

py::object tonemap(std::vector<py::object>& images, const MapOptions& options) {
    const InputImage image(images[0], "tonemap: image");
    TonemapSummary summary;
    OIIO::ImageBuf result = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::tonemap(dst, image.buf(), options, &summary, options.roi,
                                 options.nthreads);
    });
    return py::cast(
        TonemapObject{to_python(std::move(result), OutputKind::picture(image)), summary});
}

py::object calibrate(std::vector<py::object>& images, const CalibrateOptions& options) {
    const InputImage image(images[0], "calibrate: image");
    CalibrationSummary summary;
    OIIO::ImageBuf result = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::calibrate(dst, image.buf(), options, options.pixels, &summary, options.roi,
                                   options.nthreads);
    });
    return py::cast(
        CalibrateObject{to_python(std::move(result), OutputKind::picture(image)), summary});
}

void add_tonemap_results(Module& module) {
    using C = CalibrationSummary;
    ResultClass<C>(module, "CalibrationSummary", "The exposure that was found.")
        .field("mean", &C::mean, "Geometric mean of the luminance; 0: none was needed.")
        .field("key", &C::key, "That was used; 0: none was.")
        .field("exposure", &C::exposure, "Stops, of the whole image.")
        .field("white", &C::white, "0: none was asked for.")
        .field("unit", &C::unit, "cd/m2 of a pixel value of 1; 0: none was needed.")
        .field("ev100", &C::ev100, "Exposure value of the camera at ISO 100; None: no camera.")
        .field("pixels", &C::pixels, "That the statistics are of.")
        .field("adapted", &C::adapted, "Which shot it was measured on; \"\": on the image.")
        .field("warnings", &C::warnings, "What a user must know, one sentence each.")
        .field("notes", &C::notes, "What was assumed.")
        .finish();
    using S = TonemapSummary;
    ResultClass<S> result(module, "TonemapSummary", "What a picture was tone mapped with.");
    visit_source<S>(visitor(result));
    result.field("curve", &S::curve, "Curve, \"coeffs\", or \"display/view\".")
        .field("parameters", &S::parameters, "Of the curve.")
        .field("on", &S::on, "\"rgb\", \"luminance\" or \"color\".")
        .field("table", &S::table,
               "Of a curve from a file: its rows, their light, and whether it rises.")
        .field("calibration", &S::calibration, "The exposure that was found.")
        .field("nonfinite", &S::nonfinite, "Pixels with NaN or Inf.")
        .field("negative", &S::negative, "Pixels with a negative component.")
        .field("warnings", &S::warnings, "What a user must know, one sentence each.")
        .finish();
    ResultClass<TonemapObject>(module, "TonemapResult", "A tone-mapped picture and its summary.")
        .object("image", &TonemapObject::image, "Image", "The picture, with all its channels.")
        .field("summary", &TonemapObject::summary, "What it was made with.")
        .finish();
    ResultClass<CalibrateObject>(module, "CalibrateResult", "An exposed picture and its summary.")
        .object("image", &CalibrateObject::image, "Image", "The picture, linear.")
        .field("summary", &CalibrateObject::summary, "The exposure that was found.")
        .finish();
}

void add_functions(Module& module) {
    const std::string errors = "No colour, deep images, an unknown name, a value out of range, a "
                               "configuration or file that cannot be read";
    define(
        module,
        Description{"tonemap",
                    "Tone map the colour of an image, by a curve or by a view.",
                    {image_parameter("image", "Needs R, G, B; other channels are carried.")},
                    "TonemapResult",
                    "The picture, float, with the channels of the image.",
                    "Shapes: height x width x channels, R, G, B first, or an ImageBuf; the result "
                    "is what the image is.\n"
                    "Units, colour: scene light; an array is taken for linear Rec.709 unless "
                    "pixels={\"from\": ...} says otherwise. The result is encoded as `encode` says "
                    "(\"none\": linear).\n"
                    "Alpha: carried; colour is mapped as stored, associated, unless unpremult.\n"
                    "NaN and -Inf become 0, +Inf the largest value, negative components 0; all "
                    "are counted.",
                    errors + ".",
                    kTonemapSource},
        map_fields(), tonemap);
    define(module,
           Description{
               "calibrate",
               "Multiply the colour of an image by the exposure that brings its mean to a key.",
               {image_parameter("image", "Needs R, G, B, linear.")},
               "CalibrateResult",
               "The picture, linear, and the exposure.",
               "Shapes, alpha: as tonemap. Units: stops.\n"
               "NaN, Inf: such pixels stay as they are and are not in the statistics.",
               errors + ", a display-encoded image.",
               kTonemapSource},
           calibrate_fields(), calibrate);
}

} // namespace

void add_tonemap(Module& module) {
    module.add_mapping(table_of<CurveOptions>());
    module.add_mapping(table_of<ViewOptions>());
    module.add_mapping(table_of<CalibrationOptions>());
    add_tonemap_results(module);
    add_functions(module);
    define_names(module, "display_encodings", "Names of the encodings of tonemap(encode=...).",
                 kTonemapSource, ToneAlgo::display_encodings);
}

} // namespace tonetool::python
