#include "imagebuf/compare/annotate.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

namespace tonetool {
namespace {

using OIIO::ImageSpec;
using OIIO::Strutil::join;

// Attributes whose names begin alike.
struct Writer {
    ImageSpec& spec;
    std::string prefix;

    void number(const std::string& name, double value) const {
        spec.attribute(prefix + name, float(value));
    }
    void count(const std::string& name, int64_t value) const {
        // Attributes of files are 32-bit; a count beyond that stays at the largest.
        spec.attribute(prefix + name, int(std::min<int64_t>(value, INT32_MAX)));
    }
    void text(const std::string& name, const std::string& value) const {
        spec.attribute(prefix + name, value);
    }
};

void annotate_pool(const Writer& to, const FlipPool& pool) {
    to.number("meanerror", pool.mean);
    to.number("maxerror", pool.max);
    to.count("maxx", pool.max_x);
    to.count("maxy", pool.max_y);
    to.number("minerror", pool.min);
    to.number("weightedquartile1", pool.weighted_q1);
    to.number("weightedmedian", pool.weighted_median);
    to.number("weightedquartile3", pool.weighted_q3);
    to.number("p50", pool.p50);
    to.number("p95", pool.p95);
    to.number("p99", pool.p99);
    to.number("p99.9", pool.p999);
    for (const auto& [name, value] : pool.further)
        to.number(name, value);
    to.count("pixels", pool.pixels);
    // As text: integer arrays are not kept by every format.
    to.text("histogram", join(pool.histogram, " "));
}

void annotate_side(const Writer& to, const std::string& who, const FlipSide& side) {
    to.text(who + "Layer", side.layer.empty() ? "R,G,B" : side.layer);
    to.text(who + "Space", side.space);
    to.count(who + "Nonfinite", side.nonfinite);
    to.count(who + "Negative", side.negative);
    to.count(who + "Uncovered", side.uncovered);
}

template <class Summary>
void annotate_exposures(const Writer& to, const Summary& summary) {
    if (summary.exposures.empty())
        return;
    to.number("startExposure", summary.exposures.front());
    to.number("stopExposure", summary.exposures.back());
    to.count("numExposures", int64_t(summary.exposures.size()));
    if (summary.max_luminance > 0)
        to.number("maxLuminance", summary.max_luminance);
    if (summary.median_luminance > 0)
        to.number("medianLuminance", summary.median_luminance);
    to.count("medianOfLit", summary.median_of_lit);
}

void annotate_tone(const Writer& to, const FlipSummary& summary) {
    to.text("tonemapper", summary.tonemapper);
    if (!summary.coeffs.empty())
        to.text("coefficients", join(summary.coeffs, " "));
    std::vector<std::string> parameters;
    for (const auto& [name, value] : summary.parameters)
        parameters.push_back(OIIO::Strutil::fmt::format("{}={}", name, value));
    if (!parameters.empty())
        to.text("parameters", join(parameters, " "));
    if (!summary.on.empty())
        to.text("on", summary.on);
    if (summary.baked) {
        to.number("bakeErrorMax", summary.bake_error_max);
        to.number("bakeErrorMean", summary.bake_error_mean);
    }
}

void annotate_pair(const Writer& to, const PairSummary& summary) {
    annotate_pool(to, summary.pool);
    annotate_side(to, "reference", summary.reference);
    annotate_side(to, "test", summary.test);
    to.count("bothNonfinite", summary.nonfinite_both);
    to.count("unlikeNonfinite", summary.nonfinite_unlike);
    to.count("alphaIgnored", summary.alpha_ignored);
    if (summary.alpha_compared) {
        to.number("alphaMeanError", summary.alpha_mean);
        to.number("alphaMaxError", summary.alpha_max);
    }
}

void annotate_end(const Writer& to, const std::vector<std::string>& warnings) {
    if (!warnings.empty())
        to.text("warnings", join(warnings, "; "));
    to.text("version", "tonetool " TONETOOL_VERSION);
}

} // namespace

void annotate(ImageSpec& spec, const FlipSummary& summary) {
    const Writer to{spec, "FLIP:"};
    annotate_pair(to, summary);
    to.number("ppd", summary.ppd);
    if (summary.hdr) {
        annotate_tone(to, summary);
        annotate_exposures(to, summary);
    }
    annotate_end(to, summary.warnings);
}

void annotate(ImageSpec& spec, const ErrorSummary& summary) {
    const Writer to{spec, "Error:"};
    to.text("metric", summary.metric);
    to.number(summary.decibels ? "decibels" : "value", summary.value);
    if (summary.eps > 0)
        to.number("eps", summary.eps);
    if (summary.peak > 0)
        to.number("peak", summary.peak);
    annotate_pair(to, summary);
    annotate_exposures(to, summary);
    annotate_end(to, summary.warnings);
}

void annotate(ImageSpec& spec, const TmqiSummary& summary) {
    const Writer to{spec, "TMQI:"};
    to.number("Q", summary.score.q);
    to.number("S", summary.score.s);
    to.number("N", summary.score.n);
    for (size_t i = 0; i < summary.score.scales.size(); ++i)
        to.number("S" + std::to_string(i + 1), summary.score.scales[i]);
    to.number("mean", summary.score.mean);
    to.number("deviation", summary.score.deviation);
    annotate_side(to, "hdr", summary.hdr);
    annotate_side(to, "ldr", summary.ldr);
    annotate_end(to, summary.warnings);
}

} // namespace tonetool
