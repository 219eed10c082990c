#include "chain/flip_report.h"

#include "chain/error.h"

namespace tonetool::chain {

namespace {

// Lines of "label: name value".
struct Lines {
    std::string label, text;

    void add(const std::string& name, const std::string& value) {
        text += label + ": " + name + " " + value + "\n";
    }
    void add(const std::string& name, double value) { add(name, format_number(value)); }
    void add(const std::string& name, int64_t value) { add(name, std::to_string(value)); }
};

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

void add_hdr(Lines& lines, const FlipSummary& summary) {
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
    if (!summary.exposures.empty()) {
        lines.add("exposures", "start " + format_number(summary.exposures.front()) + " stop " +
                                   format_number(summary.exposures.back()) + " count " +
                                   std::to_string(summary.exposures.size()));
    }
    if (summary.max_luminance > 0) {
        lines.add("max-luminance", summary.max_luminance);
    }
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

} // namespace

std::string summary_text(const std::string& label, const FlipSummary& summary,
                         const std::string& reference, const std::string& test) {
    Lines lines{label, ""};
    add_side(lines, "reference", reference, summary.reference);
    add_side(lines, "test", test, summary.test);
    lines.add("nonfinite-in-both", summary.nonfinite_both);
    lines.add("pixels", summary.pool.pixels);
    lines.add("ppd", summary.ppd);
    if (summary.hdr) {
        add_hdr(lines, summary);
    }
    if (summary.alpha_compared) {
        lines.add("alpha-mean", summary.alpha_mean);
        lines.add("alpha-max",
                  format_number(summary.alpha_max) + at(summary.alpha_max_x, summary.alpha_max_y));
    }
    add_pool(lines, summary.pool);
    return lines.text;
}

bool judge(Session& session, const Call& call, const FlipPool& pool, const Thresholds& thresholds,
           size_t test) {
    const std::string label = call.row().label();
    const std::string of = " (" + call.images.at(test + 1)->name() + ")";
    auto value = ToneAlgo::flip_quantity(pool, thresholds.quantity);
    if (!value) {
        throw CommandError("unknown quantity \"" + thresholds.quantity + "\"");
    }
    auto compared = [&](const char* sign, double limit) {
        return thresholds.quantity + " " + format_apart(*value, limit) + sign +
               format_apart(limit, *value) + of;
    };
    if (thresholds.warn && !(*value <= *thresholds.warn)) {
        session.warning(label, compared(" > ", *thresholds.warn));
    }
    if (!thresholds.fail) {
        return false;
    }
    bool passed = *value <= *thresholds.fail;
    if (passed) {
        session.report(label + ": PASS " + compared(" <= ", *thresholds.fail));
    } else {
        ++session.failures;
        session.print(label + ": FAIL " + compared(" > ", *thresholds.fail));
    }
    return !passed;
}

} // namespace tonetool::chain
