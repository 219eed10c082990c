// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/fault_limits.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "imagebuf/pixels/names.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

[[noreturn]] void refuse(const FaultRule& rule, const std::string& text) {
    const std::string number =
        rule.threshold ? ", a number of at least 0 (" + rule.measures + "), or number,severity"
                       : "";
    throw std::runtime_error(rule.code + " is \"" + text + "\": must be off, info, warning, error" +
                             number);
}

// What cannot be above 1.
bool is_share(const FaultRule& rule) {
    return OIIO::Strutil::starts_with(rule.measures, "share ") || rule.measures == "of 1";
}

} // namespace

size_t rank_of(const FaultRules& rules, const std::string& code) {
    const auto same = [&](const FaultRule& rule) { return rule.code == code; };
    return size_t(std::find_if(rules.begin(), rules.end(), same) - rules.begin());
}

const FaultRule& FaultLimits::rule_of(const std::string& code) const {
    const size_t rank = rank_of(*m_rules, code);
    if (rank == m_rules->size()) {
        std::vector<std::string> codes;
        for (const FaultRule& rule : *m_rules)
            codes.push_back(rule.code);
        throw std::runtime_error(unknown_name("fault", code, codes));
    }
    return (*m_rules)[rank];
}

void FaultLimits::set(const std::string& code, const std::string& text) {
    const FaultRule& rule = rule_of(code);
    Limit limit{rule.severity, rule.threshold, false};
    bool has_threshold = false;
    for (const std::string& word : OIIO::Strutil::splits(text, ",")) {
        const auto severity = severity_of_name(word);
        if (!limit.has_severity && (severity || word == "off")) {
            limit.severity = severity;
            limit.has_severity = true;
        } else if (!has_threshold && rule.threshold && OIIO::Strutil::string_is_float(word)) {
            limit.threshold = OIIO::Strutil::stod(word);
            has_threshold = true;
        } else {
            refuse(rule, text);
        }
    }
    const bool valid = !limit.threshold || (*limit.threshold >= 0 && *limit.threshold < HUGE_VAL);
    if ((!limit.has_severity && !has_threshold) || !valid)
        refuse(rule, text);
    if (has_threshold && *limit.threshold >= 1 && is_share(rule))
        throw std::runtime_error(
            format("{} is \"{}\": no share is above 1, so this would find nothing "
                   "(valid: below 1, 5 % is 0.05; or off)",
                   rule.code, text));
    m_changed[code] = limit;
    m_texts[code] = text;
}

std::optional<Severity> FaultLimits::severity(const std::string& code) const {
    const auto changed = m_changed.find(code);
    return changed == m_changed.end() ? rule_of(code).severity : changed->second.severity;
}

std::optional<Severity> FaultLimits::severity(const std::string& code, Severity milder) const {
    const auto changed = m_changed.find(code);
    const bool is_set = changed != m_changed.end() && changed->second.has_severity;
    return is_set ? changed->second.severity : std::min(milder, rule_of(code).severity);
}

double FaultLimits::threshold(const std::string& code) const {
    const auto changed = m_changed.find(code);
    return (changed == m_changed.end() ? rule_of(code).threshold : changed->second.threshold)
        .value_or(0);
}

} // namespace tonetool::sequence
