// SPDX-License-Identifier: BSD-3-Clause
// What chooses cases by their names: rows of suites, --only, --approve.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tonetool::sequence {

/// "did you mean "hair/long"?" of a glob that matches none of the cases, or empty.
std::string meant_case(const std::string& glob, const std::vector<std::string>& names);

/// * stands for any characters, / too, ? for one, [a-z] and [!a-z] for one of them or one other.
bool fits_glob(const std::string& glob, const std::string& text);

/// A glob, or the whole name of a case, which may have the signs of a glob: "a[1]" is the case of
/// that name where there is one, not "a1".
class CaseGlob {
public:
    explicit CaseGlob(std::string text) : m_text(std::move(text)) {}

    void look_at(const std::set<std::string>& names) { m_is_name = names.count(m_text) != 0; }
    bool fits(const std::string& name) const;
    /// Whether it could mean several names.
    bool is_pattern() const;
    const std::string& text() const { return m_text; }

private:
    std::string m_text;
    bool m_is_name = false;
};

} // namespace tonetool::sequence
