// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/flip_report.h"

#include "imagebuf/options/ignore_options.h"
#include "sequence/results/measuring.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

std::string at(int x, int y) {
    return " at " + std::to_string(x) + "," + std::to_string(y);
}

void add_side(Lines& lines, const std::string& side, const std::string& file,
              const FlipSide& found) {
    lines.add(side, file);
    visit_side(fields(lines, found, side));
}

void add_tone(Lines& lines, const FlipSummary& summary) {
    lines.add("tonemapper", summary.tonemapper);
    if (summary.tonemapper == "coeffs") {
        Strings numbers;
        for (double k : summary.coeffs)
            numbers.push_back(format_number(k));
        lines.add("coeffs", join(numbers, ","));
    }
    for (const auto& [name, value] : summary.parameters)
        lines.add("curve-" + name, value);
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
    visit_exposed_luminance<Summary>([&](const SummaryField& field, auto member) {
        const bool of_lit = summary.median_of_lit && member == &Summary::median_luminance;
        if (summary.*member > 0)
            lines.add(key_name(field),
                      format_number(summary.*member) + (of_lit ? " of lit pixels" : ""));
    });
}

void add_pool(Lines& lines, const FlipPool& pool) {
    for (const std::string& name : ToneAlgo::flip_quantities()) {
        std::string value = format_number(ToneAlgo::flip_quantity(pool, name).value());
        std::string where = name == "min"   ? at(pool.min_x, pool.min_y)
                            : name == "max" ? at(pool.max_x, pool.max_y)
                                            : "";
        lines.add(name, value + where);
    }
    for (const auto& [name, value] : pool.further)
        lines.add(name, value);
}

void add_pair(Lines& lines, const PairSummary& summary, const std::string& reference,
              const std::string& test) {
    add_side(lines, "reference", reference, summary.reference);
    add_side(lines, "test", test, summary.test);
    visit_pair_counts(fields(lines, summary));
    visit_ignored(summary, [&](const SummaryField& field, double share) {
        lines.add(key_name(field), share);
    });
    lines.add("pixels", summary.pool.pixels);
}

void add_found(Lines& lines, const PairSummary& summary) {
    if (summary.alpha_compared) {
        visit_alpha([&](const SummaryField& field, auto member) {
            const bool placed = member == &PairSummary::alpha_max;
            lines.add(key_name(field),
                      format_number(summary.*member) +
                          (placed ? at(summary.alpha_max_x, summary.alpha_max_y) : ""));
        });
    }
    add_pool(lines, summary.pool);
}

bool holds(const sequence::Threshold& threshold, double limit) {
    return threshold.higher_is_better ? threshold.value >= limit : threshold.value <= limit;
}

std::string compared(const sequence::Threshold& threshold, double limit) {
    const bool up = threshold.higher_is_better, good = holds(threshold, limit);
    return threshold.quantity + " " + format_apart(threshold.value, limit) +
           (good ? (up ? " >= " : " <= ") : (up ? " < " : " > ")) +
           format_apart(limit, threshold.value);
}

// What the limits say of a pair.
struct Sentences {
    Strings failed, warned, passed;

    void add(const sequence::Threshold& threshold) {
        if (threshold.fail) {
            (holds(threshold, *threshold.fail) ? passed : failed)
                .push_back(compared(threshold, *threshold.fail));
        }
        if (threshold.warn && !holds(threshold, *threshold.warn))
            warned.push_back(compared(threshold, *threshold.warn));
        else if (threshold.warn && !threshold.fail)
            passed.push_back(compared(threshold, *threshold.warn));
    }
};

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
    visit_metric_options([&](const SummaryField& field, auto member) {
        lines.add_positive(key_name(field), summary.*member);
    });
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
    for (const std::string& name : ToneAlgo::tmqi_quantities())
        lines.add(name, ToneAlgo::tmqi_quantity(summary.score, name).value());
    for (size_t i = 0; i < summary.score.scales.size(); ++i)
        lines.add(scale_name(i), summary.score.scales[i]);
    visit_shown_luminance(fields(lines, summary.score));
    return lines.text;
}

Detail detail(const Session& session, const Call& call) {
    if (session.settings.quiet)
        return Detail::Nothing;
    if (call.has("print"))
        return call.flag("print", true) ? Detail::All : Detail::Nothing;
    if (session.settings.details)
        return session.frame.loops ? Detail::Line : Detail::All;
    return session.check.result && session.frame.loops ? Detail::Nothing
           : session.frame.loops                       ? Detail::Line
                                                       : Detail::Brief;
}

void record(Session& session, const Call& call, sequence::Measurement measurement, size_t test) {
    if (session.check.result) {
        measurement.command = call.row().label();
        measurement.reference = call.images.front()->name();
        measurement.test = call.images.at(test + 1)->name();
        session.check.result->measurements.push_back(std::move(measurement));
    }
}

bool judge(Session& session, const Call& call, const Limits& limits,
           const std::function<double(const std::string& quantity)>& measure,
           const std::optional<sequence::Position>& worst, size_t test,
           const std::optional<double>& ignored) {
    if (limits.empty())
        return false;
    const std::string label = call.row().label();
    Sentences said;
    std::vector<sequence::Threshold> thresholds;
    for (const Limit& limit : limits) {
        thresholds.push_back({limit.quantity, measure(limit.quantity),
                              sequence::higher_is_better(label, limit.quantity), limit.fail,
                              limit.warn, limit.automatic});
        said.add(thresholds.back());
    }
    if (session.check.result)
        session.check.result->measurements.back().thresholds = thresholds;
    const std::string where =
        worst ? ", worst pixel " + std::to_string(worst->x) + "," + std::to_string(worst->y) : "";
    const std::string file = ignored_text(ignored) + " (" + call.images.at(test + 1)->name() + ")";
    if (!said.warned.empty())
        session.warning(label, join(said.warned, ", ") + where + file);
    if (!said.failed.empty()) {
        ++session.outcome.failures;
        session.print(label + ": FAIL " + join(said.failed, ", ") + where + file);
    } else if (!said.warned.empty()) {
        session.report(label + ": WARNING " + join(said.warned, ", ") + where + file);
    } else if (!said.passed.empty() &&
               (detail(session, call) != Detail::Nothing || !session.frame.loops)) {
        session.report(label + ": PASS " + join(said.passed, ", ") + file);
    }
    return !said.failed.empty();
}

} // namespace tonetool::chain
