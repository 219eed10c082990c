// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/measurement.h"

#include <cmath>

#include "imagebuf/options/ignore_options.h"
#include "imagebuf/options/summary_fields.h"

namespace tonetool::sequence {

namespace {

void add(Measurement& to, const std::string& key, double value) {
    to.parameters.emplace_back(key, value);
}
void add(Measurement& to, const std::string& key, int64_t value) {
    to.parameters.emplace_back(key, double(value));
}
void add(Measurement& to, const std::string& key, const std::string& value) {
    to.settings.emplace_back(key, value);
}

// For summary_fields.h: of the summary, or of the image that is called so.
template <class Summary>
auto fields(Measurement& to, const Summary& summary, const std::string& of = "") {
    return [&to, &summary, of](const SummaryField& field, auto member) {
        add(to, key_name(field, of), said(field, summary.*member));
    };
}

void add_pool(Measurement& to, const FlipPool& pool) {
    for (const std::string& name : ToneAlgo::flip_quantities())
        to.quantities.emplace_back(name, ToneAlgo::flip_quantity(pool, name).value());
    for (const auto& [name, value] : pool.further)
        to.quantities.emplace_back(name, value);
    to.histogram.assign(pool.histogram.begin(), pool.histogram.end());
    to.worst = Position{pool.max_x, pool.max_y};
    to.pixels = pool.pixels;
}

template <class Summary>
void add_ignored(Measurement& to, const Summary& summary) {
    visit_ignored(
        summary, [&](const SummaryField& field, double share) { add(to, key_name(field), share); });
}

void add_pair(Measurement& to, const PairSummary& summary) {
    add_pool(to, summary.pool);
    visit_side(fields(to, summary.reference, "reference"));
    visit_side(fields(to, summary.test, "test"));
    visit_pair_counts(fields(to, summary));
    add_ignored(to, summary);
    if (summary.alpha_compared)
        visit_alpha(fields(to, summary));
    to.warnings = summary.warnings;
}

template <class Summary>
void add_exposures(Measurement& to, const Summary& summary) {
    to.exposures = summary.exposures;
    if (!summary.exposures.empty()) {
        visit_exposed_luminance<Summary>(fields(to, summary));
        to.settings.emplace_back("median-of", summary.median_of_lit ? "lit pixels" : "all pixels");
    }
}

} // namespace

Measurement measurement(const FlipSummary& summary) {
    Measurement to;
    add_pair(to, summary);
    to.parameters.emplace_back("ppd", summary.ppd);
    if (summary.hdr) {
        to.settings.emplace_back("tonemapper", summary.tonemapper);
        to.settings.emplace_back("on", summary.on);
        for (size_t i = 0; i < summary.coeffs.size(); ++i)
            to.parameters.emplace_back("coefficient-" + std::to_string(i), summary.coeffs[i]);
        for (const auto& [name, value] : summary.parameters)
            to.parameters.emplace_back("curve-" + name, value);
        if (summary.baked)
            visit_bake_error(fields(to, summary));
    }
    add_exposures(to, summary);
    return to;
}

Measurement measurement(const ErrorSummary& summary) {
    Measurement to;
    to.quantities.emplace_back(summary.metric, summary.value);
    add_pair(to, summary);
    visit_metric_options([&](const SummaryField& field, auto member) {
        if (summary.*member > 0)
            to.parameters.emplace_back(key_name(field), summary.*member);
    });
    add_exposures(to, summary);
    return to;
}

Measurement measurement(const TmqiSummary& summary) {
    Measurement to;
    for (const std::string& name : ToneAlgo::tmqi_quantities())
        to.quantities.emplace_back(name, ToneAlgo::tmqi_quantity(summary.score, name).value());
    for (size_t i = 0; i < summary.score.scales.size(); ++i)
        to.quantities.emplace_back(scale_name(i), summary.score.scales[i]);
    visit_side(fields(to, summary.hdr, "hdr"));
    visit_side(fields(to, summary.ldr, "ldr"));
    visit_shown_luminance(fields(to, summary.score));
    to.pixels = static_cast<long long>(summary.region.npixels());
    to.warnings = summary.warnings;
    return to;
}

Measurement measurement(const BiasSummary& summary) {
    const BiasResult& result = summary.result;
    Measurement to;
    to.verdict = ToneAlgo::bias_verdict_name(result.verdict);
    to.sentence = ToneAlgo::bias_sentence(result);
    to.evidence = ToneAlgo::bias_evidence(result);
    to.quantities = ToneAlgo::bias_numbers(result);
    to.settings.emplace_back("reason", ToneAlgo::bias_reason_name(result.reason));
    to.settings.emplace_back("noise-of-reference", result.options.reference);
    to.parameters = {{"within", result.options.within},
                     {"alpha", result.options.alpha},
                     {"power", result.options.power}};
    visit_side(fields(to, summary.reference, "reference"));
    visit_side(fields(to, summary.test, "test"));
    add_ignored(to, summary);
    if (const auto place = ToneAlgo::bias_place(result))
        to.worst = Position{place->x, place->y};
    const auto pixels = double(summary.region.npixels());
    to.pixels = std::llround(pixels * (1 - summary.ignored.value_or(0)));
    to.warnings = summary.warnings;
    return to;
}

} // namespace tonetool::sequence
