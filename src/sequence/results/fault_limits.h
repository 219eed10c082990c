// SPDX-License-Identifier: BSD-3-Clause
// The faults that a command looks for, and the severities and thresholds that the user sets.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// A kind of fault. Faults of equal severity are listed in the order of these rules.
struct FaultRule {
    std::string code;
    Severity severity;
    std::optional<double> threshold; ///< none: the rule measures nothing
    std::string measures;            ///< the unit of the threshold: "stops"; or empty
    std::string help;                ///< what the rule looks for
};
using FaultRules = std::vector<FaultRule>;
/// The position of a rule among these; their number if there is none.
size_t rank_of(const FaultRules& rules, const std::string& code);

/// The severities and thresholds that the user has set.
class FaultLimits {
public:
    /// The rules must live as long as this does.
    explicit FaultLimits(const FaultRules& rules) : m_rules(&rules) {}

    /// `text`: "off", "info", "warning", "error", a threshold, or both separated by a comma. Throws
    /// a runtime_error for anything else, or an unknown code.
    void set(const std::string& code, const std::string& text);
    std::optional<Severity> severity(const std::string& code) const; ///< none: off
    /// That of a case which is less severe than usual: `milder`, unless the user has set one.
    std::optional<Severity> severity(const std::string& code, Severity milder) const;
    double threshold(const std::string& code) const;
    /// The texts that were set, by code.
    const std::map<std::string, std::string>& texts() const { return m_texts; }

private:
    struct Limit {
        std::optional<Severity> severity;
        std::optional<double> threshold;
        bool has_severity = false; ///< set by the user
    };
    const FaultRule& rule_of(const std::string& code) const;

    const FaultRules* m_rules;
    std::map<std::string, Limit> m_changed;
    std::map<std::string, std::string> m_texts;
};

} // namespace tonetool::sequence
