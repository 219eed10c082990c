#include "imagebuf/annotate.h"

#include <OpenImageIO/strutil.h>

namespace tonetool {
namespace {

using OIIO::ImageSpec;
using OIIO::Strutil::join;

void number(ImageSpec& spec, const char* name, double value) {
    spec.attribute(std::string("FLIP:") + name, float(value));
}

void count(ImageSpec& spec, const char* name, int64_t value) {
    // Attributes of files are 32-bit; a count beyond that stays at the largest.
    spec.attribute(std::string("FLIP:") + name, int(std::min<int64_t>(value, INT32_MAX)));
}

void text(ImageSpec& spec, const char* name, const std::string& value) {
    spec.attribute(std::string("FLIP:") + name, value);
}

void annotate_pool(ImageSpec& spec, const FlipPool& pool) {
    number(spec, "meanerror", pool.mean);
    number(spec, "maxerror", pool.max);
    count(spec, "maxx", pool.max_x);
    count(spec, "maxy", pool.max_y);
    number(spec, "minerror", pool.min);
    number(spec, "weightedquartile1", pool.weighted_q1);
    number(spec, "weightedmedian", pool.weighted_median);
    number(spec, "weightedquartile3", pool.weighted_q3);
    number(spec, "p50", pool.p50);
    number(spec, "p95", pool.p95);
    number(spec, "p99", pool.p99);
    number(spec, "p99.9", pool.p999);
    count(spec, "pixels", pool.pixels);
    // As text: integer arrays are not kept by every format.
    text(spec, "histogram", join(pool.histogram, " "));
}

void annotate_side(ImageSpec& spec, const std::string& who, const FlipSide& side) {
    text(spec, (who + "Layer").c_str(), side.layer.empty() ? "R,G,B" : side.layer);
    text(spec, (who + "Space").c_str(), side.space);
    count(spec, (who + "Nonfinite").c_str(), side.nonfinite);
    count(spec, (who + "Negative").c_str(), side.negative);
    count(spec, (who + "Uncovered").c_str(), side.uncovered);
}

void annotate_exposures(ImageSpec& spec, const FlipSummary& summary) {
    text(spec, "tonemapper", summary.tonemapper);
    if (!summary.coeffs.empty())
        text(spec, "coefficients", join(summary.coeffs, " "));
    std::vector<std::string> parameters;
    for (const auto& [name, value] : summary.parameters)
        parameters.push_back(OIIO::Strutil::fmt::format("{}={}", name, value));
    if (!parameters.empty())
        text(spec, "parameters", join(parameters, " "));
    if (!summary.on.empty())
        text(spec, "on", summary.on);
    if (summary.baked) {
        number(spec, "bakeErrorMax", summary.bake_error_max);
        number(spec, "bakeErrorMean", summary.bake_error_mean);
    }
    number(spec, "startExposure", summary.exposures.front());
    number(spec, "stopExposure", summary.exposures.back());
    count(spec, "numExposures", int64_t(summary.exposures.size()));
    if (summary.max_luminance > 0)
        number(spec, "maxLuminance", summary.max_luminance);
    if (summary.median_luminance > 0)
        number(spec, "medianLuminance", summary.median_luminance);
    count(spec, "medianOfLit", summary.median_of_lit);
}

} // namespace

void annotate(ImageSpec& spec, const FlipSummary& summary) {
    annotate_pool(spec, summary.pool);
    annotate_side(spec, "reference", summary.reference);
    annotate_side(spec, "test", summary.test);
    count(spec, "bothNonfinite", summary.nonfinite_both);
    number(spec, "ppd", summary.ppd);
    if (summary.hdr)
        annotate_exposures(spec, summary);
    if (summary.alpha_compared) {
        number(spec, "alphaMeanError", summary.alpha_mean);
        number(spec, "alphaMaxError", summary.alpha_max);
    }
    if (!summary.warnings.empty())
        text(spec, "warnings", join(summary.warnings, "; "));
    text(spec, "version", "tonetool " TONETOOL_VERSION);
}

} // namespace tonetool
