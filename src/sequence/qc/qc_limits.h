// What --qc looks for, how bad each of it is and from where on.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// A kind of fault. In this order they are listed where they are equally severe.
struct QcRule {
    std::string code;
    Severity severity;
    std::optional<double> threshold; ///< none: there is nothing to measure
    std::string measures;            ///< what the threshold bounds: "stops"; or empty
    std::string help;                ///< what is looked for
};
const std::vector<QcRule>& qc_rules();
/// Place in that list.
size_t qc_rank(const std::string& code);

/// What was asked of the rules.
class QcLimits {
public:
    /// `text`: "off", "info", "warning", "error", a threshold, or both with a comma. A
    /// runtime_error for anything else, or an unknown code.
    void set(const std::string& code, const std::string& text);
    std::optional<Severity> severity(const std::string& code) const; ///< none: off
    double threshold(const std::string& code) const;
    /// What was set, by code.
    const std::map<std::string, std::string>& texts() const { return m_texts; }

private:
    struct Limit {
        std::optional<Severity> severity;
        std::optional<double> threshold;
    };
    std::map<std::string, Limit> m_changed;
    std::map<std::string, std::string> m_texts;
};

} // namespace tonetool::sequence
