// SPDX-License-Identifier: BSD-3-Clause
// Tables of the structs of options that several functions take.
#include "imagebuf/options/tone_options.h"
#include "python/options.h"
#include "python/shot.h"

namespace tonetool::python {

template <>
const Table<PixelOptions>& table_of<PixelOptions>() {
    using O = PixelOptions;
    static const Table<O> table = {
        "PixelOptions",
        "layer",
        "Which pixels are looked at",
        {field<O>("layer", &O::layer,
                  "Layer whose R, G, B are used, the part before \".R\"; \"\": the plain R, G, B, "
                  "else the one obvious beauty layer."),
         field<O>("from", &O::from,
                  "Colour space of the stored values, one of color_spaces(); \"\": by the header, "
                  "else linear Rec.709 for floats and sRGB for integers.")}};
    return table;
}

template <>
const Table<CurveOptions>& table_of<CurveOptions>() {
    using O = CurveOptions;
    static const Table<O> table = {
        "CurveOptions", "name", "A tone curve",
        joined<O>(
            {{field<O>("name", &O::name,
                       "One of tone_curve_names(), or a file with a table (a name with a '.' or "
                       "'/'): .spi1d, .cube, .csv, .clf, camera responses as text."),
              field<O>("parameters", &O::parameters,
                       "Parameters of the curve by name; a file has white."),
              field<O>("channel_parameters", &O::channel_parameters,
                       "Three numbers, of R, G and B, by name, of the curve \"film\"."),
              field<O>("coeffs", &O::coeffs,
                       "Six coefficients instead of the name: y = (k0 x^2 + k1 x + k2) / (k3 x^2 + "
                       "k4 x + k5); or the weights of a file with a model of camera responses.")},
             described<O, CurveOptions>(),
             {field<O>("on", &O::on, "\"rgb\", \"luminance\", or \"\": as the curve is meant."),
              field<O>("saturation", &O::saturation, "Of curves on luminance, 0 to 4.")}})};
    return table;
}

template <>
const Table<ViewOptions>& table_of<ViewOptions>() {
    using O = ViewOptions;
    static const Table<O> table = {
        "ViewOptions",
        "view",
        "A display and view of an OpenColorIO configuration",
        {field<O>("config", &O::config, "File of the configuration; \"\": $OCIO."),
         field<O>("display", &O::display, "\"\": the configuration's default."),
         field<O>("view", &O::view, "\"\": the display's default."),
         field<O>("looks", &O::looks, "Instead of the view's own."),
         field<O>("context", &O::context, "Context variables and their values.")}};
    return table;
}

template <>
const Table<CalibrationOptions>& table_of<CalibrationOptions>() {
    using O = CalibrationOptions;
    static const Table<O> table = {
        "CalibrationOptions", "method", "How the exposure is found",
        joined<O>(
            {{field<O>(
                 "method", &O::method,
                 "\"manual\": 2^stops; \"mean\": key / geometric mean; \"auto\": the same with the "
                 "key by the mean in cd/m2 (Krawczyk et al. 2005); \"camera\": by a camera's "
                 "settings "
                 "(ISO 12232).")},
             described<O, CalibrationOptions>(),
             {field<O>("white_percentile", &O::white_percentile,
                       "The curve's parameter `white` from this percentile of the calibrated "
                       "luminance; 100: the maximum."),
              field<O>("adapt", &O::adapt,
                       "The shot that is measured, and the unit; None: the image.")}})};
    return table;
}

} // namespace tonetool::python
