// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/compare/annotate.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/options/ignore_options.h"
#include "imagebuf/options/summary_fields.h"

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

    void add(const std::string& name, double value) const { number(name, value); }
    void add(const std::string& name, int64_t value) const { count(name, value); }
    void add(const std::string& name, const std::string& value) const { text(name, value); }

    /// For summary_fields.h: of the summary, or of the image that is called so.
    template <class Summary>
    auto fields(const Summary& summary, const std::string& of = "") const {
        return [this, &summary, of](const SummaryField& field, auto member) {
            this->add(attribute_name(field, of), said(field, summary.*member));
        };
    }
    /// The same without values that are 0.
    template <class Summary>
    auto positive_fields(const Summary& summary) const {
        return [this, &summary](const SummaryField& field, auto member) {
            if (summary.*member > 0)
                number(attribute_name(field), summary.*member);
        };
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

template <class Summary>
void annotate_exposures(const Writer& to, const Summary& summary) {
    if (summary.exposures.empty())
        return;
    to.number("startExposure", summary.exposures.front());
    to.number("stopExposure", summary.exposures.back());
    to.count("numExposures", int64_t(summary.exposures.size()));
    visit_exposed_luminance<Summary>(to.positive_fields(summary));
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
    if (summary.baked)
        visit_bake_error(to.fields(summary));
}

template <class Summary>
void annotate_ignored(const Writer& to, const Summary& summary) {
    visit_ignored(summary, [&](const SummaryField& field, double share) {
        to.number(attribute_name(field), share);
    });
}

void annotate_pair(const Writer& to, const PairSummary& summary) {
    annotate_pool(to, summary.pool);
    visit_side(to.fields(summary.reference, "reference"));
    visit_side(to.fields(summary.test, "test"));
    visit_pair_counts(to.fields(summary));
    annotate_ignored(to, summary);
    if (summary.alpha_compared)
        visit_alpha(to.fields(summary));
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
    visit_metric_options(to.positive_fields(summary));
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
        to.number(scale_name(i), summary.score.scales[i]);
    visit_shown_luminance(to.fields(summary.score));
    visit_side(to.fields(summary.hdr, "hdr"));
    visit_side(to.fields(summary.ldr, "ldr"));
    annotate_end(to, summary.warnings);
}

void annotate(ImageSpec& spec, const BiasSummary& summary) {
    const Writer to{spec, "Bias:"};
    const BiasResult& result = summary.result;
    to.text("verdict", ToneAlgo::bias_verdict_name(result.verdict));
    to.text("reason", ToneAlgo::bias_reason_name(result.reason));
    to.text("sentence", ToneAlgo::bias_sentence(result));
    to.number("within", result.options.within);
    to.number("alpha", result.options.alpha);
    for (const auto& [name, value] : ToneAlgo::bias_numbers(result))
        to.number(name, value);
    visit_side(to.fields(summary.reference, "reference"));
    visit_side(to.fields(summary.test, "test"));
    annotate_ignored(to, summary);
    annotate_end(to, summary.warnings);
}

} // namespace tonetool
