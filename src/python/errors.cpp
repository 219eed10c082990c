// SPDX-License-Identifier: BSD-3-Clause
// The measures that rendering papers report.
#include "tonetool/errors.h"

#include "imagebuf/options/flip_options.h"
#include "python/compare.h"
#include "python/families.h"

namespace tonetool::python {

namespace {

std::string sources() {
    std::string text;
    for (const metrics::ErrorMetric& metric : metrics::kErrorMetrics)
        if (*metric.source)
            text += std::string(text.empty() ? "" : " ") + metric.name + ": " + metric.source + ".";
    return text;
}

using ErrorCall = On<ErrorOptions>;
using ErrorObject = Imaged<ErrorSummary>;

Fields<ErrorCall> errors_fields() {
    return joined<ErrorCall>({described<ErrorCall, ErrorOptions>(),
                              pair_fields<ErrorCall>(),
                              {roi_field<ErrorCall>(), threads_field<ErrorCall>()}});
}

py::object run_errors(std::vector<py::object>& images, const ErrorCall& options) {
    const InputImage reference(images[0], "error_map: reference"),
        test(images[1], "error_map: test");
    ErrorSummary summary;
    OIIO::ImageBuf map = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::error_map(dst, reference.buf(), test.buf(), options, &summary, options.roi,
                                   options.nthreads);
    });
    return py::cast(ErrorObject{to_python(std::move(map), OutputKind::map(reference)), summary});
}

void add_errors_results(Module& module) {
    using S = ErrorSummary;
    ResultClass<S> result(module, "ErrorSummary", "A measure of the error, and how it was made.");
    result.field("metric", &S::metric, "Which.")
        .field("value", &S::value, "The measure.")
        .field("decibels", &S::decibels, "It is in dB, higher is better; else 0 is best.");
    visit_metric_options(visitor(result));
    add_exposures(result, "Of mpsnr: stops, ascending.");
    add_pair_summary(result);
    result.finish();
    ResultClass<ErrorObject>(module, "ErrorResult", "The map of an error and its summary.")
        .object("map", &ErrorObject::image, "Image", "Error of each pixel, one channel.")
        .field("summary", &ErrorObject::summary, "The measure and what it was made with.")
        .finish();
}

} // namespace

void add_errors(Module& module) {
    add_errors_results(module);
    define(
        module,
        Description{
            "error_map",
            "The map of one of error_metrics(), and the measure of it.",
            {reference_parameter(), test_parameter()},
            "ErrorResult",
            "The map, and in `summary` the measure.",
            pair_notes("Units: those of the metric, the mean over R, G, B of each pixel; psnr and "
                       "mpsnr are in dB, higher is better.\nNegative components count as 0.\n"
                       "NaN, Inf: a pixel that has them in one image counts as the largest "
                       "error of the map, alike in both as 0. Where the test alone has them, the "
                       "value and the mean of measures without a bound are inf (psnr: -inf). "
                       "Counted, and in summary.warnings."),
            "No metric, or an unknown one, no R, G, B, deep images, different display windows, a "
            "value out "
            "of range, an unreadable file, no finite pixel.",
            sources()},
        errors_fields(), run_errors);
    define_names(module, "error_metrics", "Names of the metrics of error_map().", sources(),
                 ToneAlgo::error_metrics);
}

} // namespace tonetool::python
