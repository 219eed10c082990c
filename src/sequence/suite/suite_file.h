// SPDX-License-Identifier: BSD-3-Clause
// A suite: named cases with their limits, as a file says them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sequence/suite/case_glob.h"

namespace tonetool::sequence {

/// What a row of the file, or all rows that match a case, say: by key, "fail", "skip", ...
struct SuiteSetting {
    std::string text;
    int line = 0; ///< of the [[case]] row
};
using SuiteSettings = std::map<std::string, SuiteSetting>;

struct SuiteRow {
    CaseGlob name{"*"}, method{"*"};
    SuiteSettings settings;
    int line = 0;
    std::string shown; ///< the row as messages show it, with its line and a caret
};

struct Suite {
    std::string file, folder; ///< `folder` ends with a / or is empty
    std::string name, reference, test, check;
    int test_line = 0;
    bool attribute = false; ///< of what fails, find out whose error it is
    std::vector<SuiteRow> rows;

    /// The keys that hold for a case: every row that matches it holds, later ones win.
    SuiteSettings settings_of(const std::string& name, const std::string& method) const;
    /// Tells the rows which cases there are (their names and methods). Returns what is wrong with
    /// the first that matches none; empty where each matches one.
    std::string unmatched(const std::vector<std::pair<std::string, std::string>>& cases);
    /// A file name of the suite file as the program opens it.
    std::string path(const std::string& name) const;
};

/// Throws a runtime_error with the line and a caret where the text is no suite.
Suite suite_from(const std::string& text, const std::string& file);

} // namespace tonetool::sequence
