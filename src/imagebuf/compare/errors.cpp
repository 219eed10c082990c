// SPDX-License-Identifier: BSD-3-Clause
// The public functions of include/tonetool/errors.h.
#include "tonetool/errors.h"

#include <OpenImageIO/strutil.h>
#include <utility>

#include "imagebuf/compare/annotate.h"
#include "imagebuf/compare/flip_run.h"
#include "imagebuf/options/flip_options.h"
#include "imagebuf/pixels/deliver.h"
#include "imagebuf/pixels/guard.h"

namespace tonetool {
namespace {

using metrics::ErrorMetric;
using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

ErrorSummary summarize(const ErrorMetric& metric, const ErrorOptions& options,
                       FlipSummary&& found) {
    ErrorSummary s;
    static_cast<PairSummary&>(s) = std::move(static_cast<PairSummary&>(found));
    s.metric = metric.name;
    s.eps = metric.has(metrics::kEps) ? options.eps : 0;
    s.peak = metric.has(metrics::kPeak) ? options.peak : 0;
    s.decibels = metric.has(metrics::kDecibels);
    if (metric.has(metrics::kExposures)) {
        s.exposures = std::move(found.exposures);
        s.max_luminance = found.max_luminance;
        s.median_luminance = found.median_luminance;
        s.median_of_lit = found.median_of_lit;
    }
    s.value = metric.measure(s.pool.mean, s.peak > 0 ? s.peak : 1);
    return s;
}

void measure(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
             const ErrorOptions& options, ErrorSummary* summary, ROI roi, int nthreads) {
    const ErrorMetric* known = metrics::find_error_metric(options.metric);
    ErrorOptions used = options;
    if (known && !known->has(metrics::kExposures))
        used.start_exposure = used.stop_exposure = {}, used.num_exposures = {};
    check_options(used);
    const ErrorMetric& metric = *known;
    const FlipPlan plan =
        plan_errors(options, {metric.kind, options.eps}, metric.has(metrics::kExposures));
    std::vector<ImageBuf> maps;
    std::vector<FlipResult> results;
    run_flip(plan, reference, {&test}, {&dst}, roi, nthreads, maps, results);
    ErrorSummary found = summarize(metric, options, std::move(results[0].summary));
    annotate(maps[0].specmod(), found);
    deliver(dst, std::move(maps[0]), "Error:");
    if (summary)
        *summary = std::move(found);
}

} // namespace

namespace ToneAlgo {

bool error_map(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
               const ErrorOptions& options, ErrorSummary* summary, ROI roi, int nthreads) {
    return guarded(dst, "error_map",
                   [&] { measure(dst, reference, test, options, summary, roi, nthreads); });
}

ImageBuf error_map(const ImageBuf& reference, const ImageBuf& test, const ErrorOptions& options,
                   ErrorSummary* summary, ROI roi, int nthreads) {
    ImageBuf dst;
    error_map(dst, reference, test, options, summary, roi, nthreads);
    return dst;
}

std::vector<std::string> error_metrics() {
    std::vector<std::string> names;
    for (const ErrorMetric& metric : metrics::kErrorMetrics)
        names.emplace_back(metric.name);
    return names;
}

} // namespace ToneAlgo
} // namespace tonetool
