#include "sequence/results/measurement.h"

namespace tonetool::sequence {

namespace {

void add_side(Measurement& to, const std::string& side, const FlipSide& found) {
    to.settings.emplace_back(side + "-layer", found.layer.empty() ? "R,G,B" : found.layer);
    to.settings.emplace_back(side + "-space", found.space);
    to.parameters.emplace_back(side + "-nonfinite", double(found.nonfinite));
    to.parameters.emplace_back(side + "-negative", double(found.negative));
    to.parameters.emplace_back(side + "-uncovered", double(found.uncovered));
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

void add_pair(Measurement& to, const PairSummary& summary) {
    add_pool(to, summary.pool);
    add_side(to, "reference", summary.reference);
    add_side(to, "test", summary.test);
    to.parameters.emplace_back("nonfinite-in-both", double(summary.nonfinite_both));
    to.parameters.emplace_back("nonfinite-unlike", double(summary.nonfinite_unlike));
    to.parameters.emplace_back("alpha-ignored", double(summary.alpha_ignored));
    if (summary.alpha_compared) {
        to.parameters.emplace_back("alpha-mean", summary.alpha_mean);
        to.parameters.emplace_back("alpha-max", summary.alpha_max);
    }
    to.warnings = summary.warnings;
}

template <class Summary>
void add_exposures(Measurement& to, const Summary& summary) {
    to.exposures = summary.exposures;
    if (!summary.exposures.empty()) {
        to.parameters.emplace_back("max-luminance", summary.max_luminance);
        to.parameters.emplace_back("median-luminance", summary.median_luminance);
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
        if (summary.baked) {
            to.parameters.emplace_back("bake-error-max", summary.bake_error_max);
            to.parameters.emplace_back("bake-error-mean", summary.bake_error_mean);
        }
    }
    add_exposures(to, summary);
    return to;
}

Measurement measurement(const ErrorSummary& summary) {
    Measurement to;
    to.quantities.emplace_back(summary.metric, summary.value);
    add_pair(to, summary);
    if (summary.eps > 0)
        to.parameters.emplace_back("eps", summary.eps);
    if (summary.peak > 0)
        to.parameters.emplace_back("peak", summary.peak);
    add_exposures(to, summary);
    return to;
}

Measurement measurement(const TmqiSummary& summary) {
    Measurement to;
    for (const std::string& name : ToneAlgo::tmqi_quantities())
        to.quantities.emplace_back(name, ToneAlgo::tmqi_quantity(summary.score, name).value());
    for (size_t i = 0; i < summary.score.scales.size(); ++i)
        to.quantities.emplace_back("S" + std::to_string(i + 1), summary.score.scales[i]);
    add_side(to, "hdr", summary.hdr);
    add_side(to, "ldr", summary.ldr);
    to.parameters.emplace_back("ldr-mean", summary.score.mean);
    to.parameters.emplace_back("ldr-deviation", summary.score.deviation);
    to.pixels = static_cast<long long>(summary.region.npixels());
    to.warnings = summary.warnings;
    return to;
}

} // namespace tonetool::sequence
