#include "measure/flip_report.h"

#include "measure/check_part.h"
#include "text/error.h"

namespace tonetool::measure {

namespace {

std::string at(int x, int y) {
    return " at " + std::to_string(x) + "," + std::to_string(y);
}

void add_side(Lines& lines, const std::string& side, const std::string& file,
              const FlipSide& found) {
    lines.add(side, file);
    lines.add(side + "-layer", found.layer.empty() ? "R,G,B" : found.layer);
    lines.add(side + "-space", found.space);
    lines.add(side + "-nonfinite", found.nonfinite);
    lines.add(side + "-negative", found.negative);
    lines.add(side + "-uncovered", found.uncovered);
}

void add_tone(Lines& lines, const FlipSummary& summary) {
    lines.add("tonemapper", summary.tonemapper);
    if (summary.tonemapper == "coeffs") {
        Strings numbers;
        for (double k : summary.coeffs) {
            numbers.push_back(format_number(k));
        }
        lines.add("coeffs", join(numbers, ","));
    }
    for (const auto& [name, value] : summary.parameters) {
        lines.add("curve-" + name, value);
    }
    if (summary.baked) {
        lines.add("bake-error", "max " + format_number(summary.bake_error_max) + " mean " +
                                    format_number(summary.bake_error_mean));
    }
}

template <class Summary>
void add_exposures(Lines& lines, const Summary& summary) {
    if (!summary.exposures.empty()) {
        lines.add("exposures", "start " + format_number(summary.exposures.front()) + " stop " +
                                   format_number(summary.exposures.back()) + " count " +
                                   std::to_string(summary.exposures.size()));
    }
    lines.add_positive("max-luminance", summary.max_luminance);
    if (summary.median_luminance > 0) {
        lines.add("median-luminance", format_number(summary.median_luminance) +
                                          (summary.median_of_lit ? " of lit pixels" : ""));
    }
}

void add_pool(Lines& lines, const FlipPool& pool) {
    for (const std::string& name : ToneAlgo::flip_quantities()) {
        std::string value = format_number(ToneAlgo::flip_quantity(pool, name).value());
        std::string where = name == "min"   ? at(pool.min_x, pool.min_y)
                            : name == "max" ? at(pool.max_x, pool.max_y)
                                            : "";
        lines.add(name, value + where);
    }
}

void add_pair(Lines& lines, const PairSummary& summary, const std::string& reference,
              const std::string& test) {
    add_side(lines, "reference", reference, summary.reference);
    add_side(lines, "test", test, summary.test);
    lines.add("nonfinite-in-both", summary.nonfinite_both);
    lines.add("pixels", summary.pool.pixels);
}

void add_found(Lines& lines, const PairSummary& summary) {
    if (summary.alpha_compared) {
        lines.add("alpha-mean", summary.alpha_mean);
        lines.add("alpha-max",
                  format_number(summary.alpha_max) + at(summary.alpha_max_x, summary.alpha_max_y));
    }
    add_pool(lines, summary.pool);
}

} // namespace

std::string summary_text(const std::string& label, const FlipSummary& summary,
                         const std::string& first, const std::string& second) {
    Lines lines(label);
    add_pair(lines, summary, first, second);
    lines.add("ppd", summary.ppd);
    if (summary.hdr) {
        add_tone(lines, summary);
        add_exposures(lines, summary);
    }
    add_found(lines, summary);
    return lines.text;
}

std::string summary_text(const std::string& label, const ErrorSummary& summary,
                         const std::string& first, const std::string& second) {
    Lines lines(label);
    add_pair(lines, summary, first, second);
    lines.add_positive("eps", summary.eps);
    lines.add_positive("peak", summary.peak);
    add_exposures(lines, summary);
    lines.add(summary.metric, summary.value);
    add_found(lines, summary);
    return lines.text;
}

std::string summary_text(const std::string& label, const TmqiSummary& summary,
                         const std::string& first, const std::string& second) {
    Lines lines(label);
    add_side(lines, "hdr", first, summary.hdr);
    add_side(lines, "ldr", second, summary.ldr);
    for (const std::string& name : ToneAlgo::tmqi_quantities()) {
        lines.add(name, ToneAlgo::tmqi_quantity(summary.score, name).value());
    }
    for (size_t i = 0; i < summary.score.scales.size(); ++i) {
        lines.add("S" + std::to_string(i + 1), summary.score.scales[i]);
    }
    lines.add("ldr-mean", summary.score.mean);
    lines.add("ldr-deviation", summary.score.deviation);
    return lines.text;
}

void record(Session& session, const Call& call, sequence::Measurement measurement, size_t test) {
    if (result_of(session)) {
        measurement.command = call.row().label();
        measurement.reference = call.images.front()->name();
        measurement.test = call.images.at(test + 1)->name();
        result_of(session)->measurements.push_back(std::move(measurement));
    }
}

bool judge(Session& session, const Call& call, const Thresholds& thresholds,
           const Measured& measured, size_t test) {
    const std::string label = call.row().label();
    const double value = measured.value;
    const bool up = measured.higher_is_better;
    if (result_of(session) && (thresholds.fail || thresholds.warn)) {
        result_of(session)->measurements.back().threshold =
            sequence::Threshold{thresholds.quantity, value, up, thresholds.fail, thresholds.warn};
    }
    auto passes = [&](double limit) { return up ? value >= limit : value <= limit; };
    auto compared = [&](double limit) {
        const char* sign = passes(limit) ? (up ? " >= " : " <= ") : (up ? " < " : " > ");
        return thresholds.quantity + " " + format_apart(value, limit) + sign +
               format_apart(limit, value) + " (" + call.images.at(test + 1)->name() + ")";
    };
    if (thresholds.warn && !passes(*thresholds.warn)) {
        session.warning(label, compared(*thresholds.warn));
    }
    if (!thresholds.fail) {
        return false;
    }
    if (passes(*thresholds.fail)) {
        session.report(label + ": PASS " + compared(*thresholds.fail));
        return false;
    }
    ++session.failures;
    session.print(label + ": FAIL " + compared(*thresholds.fail));
    return true;
}

} // namespace tonetool::measure
