// SPDX-License-Identifier: BSD-3-Clause
// The registry of tone curves.
#include "python/families.h"
#include "python/results.h"
#include "tonetool/tonemap.h"

namespace tonetool::python {

namespace {

const std::string kCurvesSource = "The publication that tone_curves() names for each curve.";

py::object response(std::vector<py::object>& arguments, const CurveOptions& options) {
    const std::vector<double> values =
        Python<std::vector<double>>::from(arguments[0], "tone_curve_response: values");
    std::vector<double> light;
    run_or_raise("tone_curve_response", [&](std::string& error) {
        return ToneAlgo::tone_curve_response(light, options, values, error);
    });
    return py::array_t<double>(py::ssize_t(light.size()), light.data());
}

py::object of_file(std::vector<py::object>&, const CurveOptions& options) {
    ToneCurveInfo info;
    run_or_raise("tone_curve_of_file", [&](std::string& error) {
        return ToneAlgo::tone_curve_of_file(info, options, error);
    });
    return py::cast(info);
}

void add_curves_results(Module& module) {
    using P = ToneCurveParameter;
    ResultClass<P>(module, "ToneCurveParameter", "A parameter of a tone curve.")
        .field("name", &P::name, "Its name.")
        .field("help", &P::help, "What it does.")
        .field("value", &P::value, "Its default.")
        .field("low", &P::low, "Its smallest value.")
        .field("high", &P::high, "Its largest value.")
        .field("flip_value", &P::flip_value, "Its default in HDR-FLIP.")
        .field("per_channel", &P::per_channel, "R, G and B may have values of their own.")
        .finish();
    using I = ToneCurveInfo;
    ResultClass<I>(module, "ToneCurveInfo", "A tone curve of the registry.")
        .field("name", &I::name, "Its name.")
        .field("title", &I::title, "Its full name.")
        .field("source", &I::source, "Where it is published.")
        .field("formula", &I::formula, "What it computes.")
        .field("note", &I::note, "What is worth knowing.")
        .field("domain", &I::domain, "\"rgb\", \"luminance\" or \"color\".")
        .field("encoded", &I::encoded, "The published formula's encoding is undone.")
        .field("parameters", &I::parameters, "Its parameters.")
        .field("coefficients", &I::coefficients, "Six, with its defaults; empty: it has none.")
        .finish();
}

} // namespace

void add_curves(Module& module) {
    add_curves_results(module);
    const Description list = {"tone_curves",
                              "The tone curves, with their sources and parameters.",
                              {},
                              "list[ToneCurveInfo]",
                              "One each.",
                              "Units: parameters in scene light unless their help says otherwise.",
                              "Never.",
                              kCurvesSource};
    define(module, list, [](std::vector<py::object>&) { return list_of(ToneAlgo::tone_curves()); });
    define_names(module, "tone_curve_names", "Names of the tone curves.", kCurvesSource,
                 ToneAlgo::tone_curve_names);
    define(
        module,
        Description{"tone_curve_of_file",
                    "A curve from a file, as tone_curves() describes those of the registry.",
                    {},
                    "ToneCurveInfo",
                    "Its note says how many rows it has, over which light, and whether it rises.",
                    "Units: x is scene light, the result display light. NaN is refused.",
                    "A file that is no curve; the error names the line.",
                    kCurvesSource},
        table_of<CurveOptions>().fields, of_file);
    define(module,
           Description{
               "tone_curve_response",
               "What a tone curve makes of greys.",
               {{"values", "Sequence[float]", "Exposed scene values.", ""}},
               "NDArray[np.float64]",
               "Display light of each, unclamped, a one-dimensional "
               "array.",
               "Shapes: one dimension. Units: 1 is the display's white. It is the formula itself, "
               "of negative values and infinities, too, which tonemap() takes for 0 and 65504; "
               "NaN gives NaN or is refused by the curve.",
               "An unknown curve or parameter, a value out of range.",
               kCurvesSource},
           table_of<CurveOptions>().fields, response);
}

} // namespace tonetool::python
