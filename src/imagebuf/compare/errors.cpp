// The public functions of include/tonetool/errors.h.
#include "tonetool/errors.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "imagebuf/compare/annotate.h"
#include "imagebuf/compare/flip_run.h"
#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/deliver.h"
#include "imagebuf/pixels/guard.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using metrics::ErrorKind;
using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

struct Metric {
    const char* name;
    ErrorKind kind;
    bool eps, decibels;
};

constexpr Metric kMetrics[] = {{"smape", ErrorKind::Symmetric, true, false},
                               {"rmae", ErrorKind::RelativeAbsolute, true, false},
                               {"relmse", ErrorKind::RelativeSquared, true, false},
                               {"mse", ErrorKind::Squared, false, false},
                               {"mae", ErrorKind::Absolute, false, false},
                               {"psnr", ErrorKind::Squared, false, true},
                               {"mpsnr", ErrorKind::Exposed, false, true}};

const Metric& find_metric(const std::string& name) {
    for (const Metric& metric : kMetrics)
        if (name == metric.name)
            return metric;
    throw Refusal("unknown metric \"" + name +
                  "\"; valid: " + OIIO::Strutil::join(ToneAlgo::error_metrics(), ", "));
}

// Beyond these the squares leave what a double tells apart.
constexpr double kLeast = 1e-12, kMost = 1e12;

ErrorSummary summarize(const Metric& metric, const ErrorOptions& options, FlipSummary&& found) {
    ErrorSummary s;
    static_cast<PairSummary&>(s) = std::move(static_cast<PairSummary&>(found));
    s.metric = metric.name;
    s.eps = metric.eps ? options.eps : 0;
    s.decibels = metric.decibels;
    if (metric.kind == ErrorKind::Exposed) {
        s.exposures = std::move(found.exposures);
        s.max_luminance = found.max_luminance;
        s.median_luminance = found.median_luminance;
        s.median_of_lit = found.median_of_lit;
    } else if (metric.decibels) {
        s.peak = options.peak;
    }
    const double largest = s.peak > 0 ? s.peak : 1;
    s.value = metric.decibels ? 10 * std::log10(largest * largest / s.pool.mean) : s.pool.mean;
    return s;
}

void measure(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
             const ErrorOptions& options, ErrorSummary* summary, ROI roi, int nthreads) {
    const Metric& metric = find_metric(options.metric);
    check_range(options.eps, kLeast, kMost, "eps");
    check_range(options.peak, kLeast, kMost, "peak");
    const FlipPlan plan =
        plan_errors(options, {metric.kind, options.eps}, metric.kind == ErrorKind::Exposed);
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
    for (const Metric& metric : kMetrics)
        names.emplace_back(metric.name);
    return names;
}

} // namespace ToneAlgo
} // namespace tonetool
