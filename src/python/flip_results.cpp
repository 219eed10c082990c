// SPDX-License-Identifier: BSD-3-Clause
#include "python/flip_results.h"

#include "python/families.h"

namespace tonetool::python {

namespace {

py::object map_or_none(OIIO::ImageBuf&& image, const InputImage& reference) {
    if (!image.initialized())
        return py::none();
    return to_python(std::move(image), OutputKind::map(reference));
}

void add_summary(Module& module) {
    using S = FlipSummary;
    ResultClass<S> result(module, "FlipSummary", "What FLIP found, and what it was found with.");
    add_pair_summary(result);
    result.field("ppd", &S::ppd, "Pixels per degree.")
        .field("hdr", &S::hdr, "HDR-FLIP, not LDR-FLIP.")
        .field("tonemapper", &S::tonemapper, "Curve, \"coeffs\", or \"display/view\".")
        .field("parameters", &S::parameters, "Of the curve.")
        .field("on", &S::on, "\"rgb\", \"luminance\" or \"color\".")
        .field("coeffs", &S::coeffs, "Six coefficients of the curve; empty where it has none.")
        .field("bright", &S::bright, "Scene value of a grey that is shown at 0.85; 0: none.")
        .field("baked", &S::baked, "The view was shown through a table.");
    visit_bake_error(visitor(result));
    add_exposures(result, "Stops, ascending; empty for LDR-FLIP.");
    result.finish();
}

py::object quantity_of_flip(std::vector<py::object>& arguments) {
    if (!py::isinstance<FlipPool>(arguments[0]))
        wrong_type("flip_quantity: pool", arguments[0], "a FlipPool");
    const auto& pool = arguments[0].cast<const FlipPool&>();
    std::vector<std::string> names = ToneAlgo::flip_quantities();
    for (const auto& one : pool.further)
        names.push_back(one.first);
    if (py::isinstance<py::str>(arguments[1]))
        if (const auto known = ToneAlgo::flip_quantity_name(arguments[1].cast<std::string>()))
            arguments[1] = py::str(*known);
    const size_t place = place_of(arguments[1], "flip_quantity: name", names);
    return Python<std::optional<double>>::to(ToneAlgo::flip_quantity(pool, names[place]));
}

} // namespace

py::object flip_object(OIIO::ImageBuf&& map, FlipResult&& result, const InputImage& reference) {
    FlipObject object;
    object.image = to_python(std::move(map), OutputKind::map(reference));
    object.summary = std::move(result.summary);
    object.exposure_stops = map_or_none(std::move(result.exposure_stops), reference);
    object.exposure_index = map_or_none(std::move(result.exposure_index), reference);
    const OutputKind picture = OutputKind::picture(reference);
    for (FlipExposure& one : result.exposures)
        object.exposures.push_back({one.stops, to_python(std::move(one.reference), picture),
                                    to_python(std::move(one.test), picture),
                                    map_or_none(std::move(one.flip), reference)});
    return py::cast(std::move(object));
}

void add_flip_results(Module& module) {
    add_summary(module);
    using E = ExposureObject;
    ResultClass<E>(module, "FlipExposure", "One exposure of HDR-FLIP.")
        .field("stops", &E::stops, "The exposure.")
        .object("reference", &E::reference, "Image", "As it was compared: display-linear, 0 to 1.")
        .object("test", &E::test, "Image", "As it was compared.")
        .object("flip", &E::flip, "Image", "LDR-FLIP of the two.")
        .finish();
    using F = FlipObject;
    ResultClass<F>(module, "FlipResult", "The map of FLIP and its summary.")
        .object("map", &F::image, "Image", "Error, 0 to 1, one channel.")
        .field("summary", &F::summary, "Numbers, and what they were made with.")
        .object("exposure_stops", &F::exposure_stops, "Image | None",
                "Exposure of the largest error, in stops.")
        .object("exposure_index", &F::exposure_index, "Image | None", "Its index, 0 to N-1.")
        .field("exposures", &F::exposures, "One each, where they were wanted.")
        .finish();
    ResultClass<FilmstripObject>(module, "FilmstripResult", "A filmstrip and its summary.")
        .object("image", &FilmstripObject::image, "Image", "R, G, B, sRGB-encoded.")
        .field("summary", &FilmstripObject::summary, "Numbers of HDR-FLIP.")
        .finish();
    define(module,
           Description{
               "flip_quantity",
               "A figure of the summary by the name the program has for it.",
               {{"pool", "FlipPool", "Of a summary.", ""},
                {"name", "str", "One of flip_quantities(), or what quantities= asked for.", ""}},
               "float",
               "The figure.",
               "Units: FLIP, 0 to 1, or that of the error's metric.",
               "Never.",
               "Weighted quantities: P. Andersson et al., \"FLIP: A Difference Evaluator for "
               "Alternating Images\", HPG 2020."},
           quantity_of_flip);
}

} // namespace tonetool::python
