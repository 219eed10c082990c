// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/held.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "text/text.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

std::string text_of(const std::string& key, const Limits& limits) {
    std::vector<std::string> words;
    for (const auto& [name, limit] : limits)
        words.push_back(format("{}={}", name, limit));
    return words.empty() ? "no " + key + "=" : key + "=" + join(words, ",");
}

std::string other_limits(const Measurement& measured, const Asked& asked) {
    Limits fail, warn;
    for (const Threshold& threshold : measured.thresholds) {
        if (threshold.fail)
            fail[threshold.quantity] = *threshold.fail;
        if (threshold.warn)
            warn[threshold.quantity] = *threshold.warn;
    }
    const auto compared = [](const std::string& key, const Limits& held, const Limits& wanted) {
        return held == wanted ? ""
                              : format(" was held to {}, but the check's limit is {}",
                                       text_of(key, held), text_of(key, wanted));
    };
    const std::string of_fail = compared("fail", fail, asked.fail);
    return of_fail.empty() ? compared("warn", warn, asked.warn) : of_fail;
}

// A comparison of values has one threshold: of the pixels that differ, of the largest difference,
// or of images that are not alike in more than their pixels.
std::string other_diff_limit(const Measurement& measured, const Asked& asked) {
    if (measured.thresholds.size() != 1 ||
        measured.thresholds[0].fail.has_value() == measured.thresholds[0].warn.has_value())
        return " has not the one limit of a comparison of values";
    const Threshold& only = measured.thresholds[0];
    if (only.quantity == "differing-images") {
        return only.value == 1 && only.fail == 0.0 ? ""
                                                   : " has differing-images that do not differ";
    }
    const bool fails = only.fail.has_value();
    const DiffLimit& wanted = fails ? asked.diff.fail : asked.diff.warn;
    const double limit =
        only.quantity == "max" ? double(wanted.hardest) : wanted.allowed(double(measured.pixels));
    if (only.quantity != "max" && only.quantity != "differing-pixels")
        return " has a limit of " + only.quantity + " (valid: differing-pixels, max)";
    const double held = fails ? *only.fail : *only.warn;
    return held == limit ? ""
                         : format(" was held to {} {}={}, but the check's limit is {}",
                                  only.quantity, fails ? "fail" : "warn", held, limit);
}

std::string other_verdict_limits(const Measurement& measured, const Asked& asked) {
    const auto same = [](const Threshold& a, const Threshold& b) {
        return a.quantity == b.quantity && a.value == b.value && a.fail == b.fail &&
               a.warn == b.warn;
    };
    const auto wanted = verdict_thresholds(measured, asked.verdict);
    if (!std::equal(wanted.begin(), wanted.end(), measured.thresholds.begin(),
                    measured.thresholds.end(), same)) {
        return format(" has other thresholds than its verdict \"{}\" and the check's fail= and "
                      "inconclusive= give",
                      measured.verdict);
    }
    for (const auto& [name, wants] :
         {std::pair("within", asked.within), std::pair("alpha", asked.alpha)}) {
        const auto& all = measured.parameters;
        const auto found = std::find_if(all.begin(), all.end(),
                                        [key = name](const auto& one) { return one.first == key; });
        if (found == all.end())
            return format(" does not say with which {} it was tested", name);
        if (found->second != wants)
            return format(" was tested with {}={}, but the check has {}", name, found->second,
                          wants);
    }
    return "";
}

} // namespace

std::string not_held(const Measurement& measured, const Asked& asked) {
    const MeasuringCommand& command = *measuring_command(measured.command);
    return command.compares_values()             ? other_diff_limit(measured, asked)
           : command.scoring == Scoring::Verdict ? other_verdict_limits(measured, asked)
                                                 : other_limits(measured, asked);
}

} // namespace tonetool::sequence
