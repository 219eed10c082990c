// SPDX-License-Identifier: BSD-3-Clause
// The faults that --qc looks for, each with its severity and threshold.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// A kind of fault. Faults of equal severity are listed in the order of these rules.
struct QcRule {
    std::string code;
    Severity severity;
    std::optional<double> threshold; ///< none: the rule measures nothing
    std::string measures;            ///< the unit of the threshold: "stops"; or empty
    std::string help;                ///< what the rule looks for
};
const std::vector<QcRule>& qc_rules();
/// The position of a rule in that list.
size_t qc_rank(const std::string& code);

/// The severities and thresholds that the user has set.
class QcLimits {
public:
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
    std::map<std::string, Limit> m_changed;
    std::map<std::string, std::string> m_texts;
};

} // namespace tonetool::sequence
