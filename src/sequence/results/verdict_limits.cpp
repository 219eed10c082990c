// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/verdict_limits.h"

#include <OpenImageIO/strutil.h>

#include "tonetool/bias.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

bool is(const std::string& verdict, BiasVerdict one) {
    return verdict == ToneAlgo::bias_verdict_name(one);
}

Threshold threshold_of(const char* name, bool found, bool fails) {
    Threshold threshold{name, found ? 1.0 : 0.0, false, {}, {}};
    (fails ? threshold.fail : threshold.warn) = 0;
    return threshold;
}

std::string setting_of(const Measurement& measured, const std::string& name) {
    for (const auto& [key, value] : measured.settings)
        if (key == name)
            return value;
    return "";
}

double parameter_of(const Measurement& measured, const std::string& name) {
    for (const auto& [key, value] : measured.parameters)
        if (key == name)
            return value;
    return 0;
}

// Of every pixel, or of what is not above the margin.
bool shows_equality(const Measurement& measured) {
    const std::string reason = setting_of(measured, "reason");
    if (reason == ToneAlgo::bias_reason_name(BiasReason::Identical) ||
        reason == ToneAlgo::bias_reason_name(BiasReason::Rounding))
        return true;
    const double within = parameter_of(measured, "within");
    const auto holds = [&](const char* name) {
        const auto value = quantity_of(measured, name);
        return value && *value <= within;
    };
    return holds("bound") || holds("absolute");
}

} // namespace

std::vector<Threshold> verdict_thresholds(const Measurement& measured,
                                          const VerdictLimits& limits) {
    const std::string& verdict = measured.verdict;
    const bool small =
        setting_of(measured, "reason") == ToneAlgo::bias_reason_name(BiasReason::TooSmall);
    const std::string inconclusive = small ? "fail" : limits.inconclusive;
    std::vector<Threshold> thresholds{
        threshold_of(kDifferentName, is(verdict, BiasVerdict::Different), limits.fails)};
    if (inconclusive != "pass") {
        thresholds.push_back(threshold_of(
            kUndecidedName, is(verdict, BiasVerdict::NotEnoughSamples), inconclusive == "fail"));
    }
    return thresholds;
}

std::string contradictory_verdict(const Measurement& measured) {
    const std::string& verdict = measured.verdict;
    const bool different = is(verdict, BiasVerdict::Different);
    if (!different && !is(verdict, BiasVerdict::Equal) &&
        !is(verdict, BiasVerdict::NotEnoughSamples))
        return format(" has the verdict \"{}\" (valid: different, equal, not enough samples)",
                      verdict);
    if (measured.sentence.compare(0, verdict.size(), verdict) != 0)
        return format(" has the verdict \"{}\", but the sentence \"{}\"", verdict,
                      measured.sentence);
    if (different && measured.evidence.empty())
        return " is different without any evidence";
    if (is(verdict, BiasVerdict::Equal) &&
        (!shows_equality(measured) || quantity_of(measured, "nonfinite").value_or(0) != 0))
        return " is equal, but its numbers do not show it";
    return "";
}

} // namespace tonetool::sequence
