// SPDX-License-Identifier: BSD-3-Clause
// What came of a command line: what its exit status is made from, and what is looked at when it
// ends.
#pragma once

#include <map>
#include <set>
#include <string>

#include "chain/session/settings.h"
#include "text/text.h"

namespace tonetool::chain {

struct Outcome {
    bool produced = false;         ///< something was written, printed or measured
    bool produced_by_name = false; ///< --echo and the like: also of images that no command used
    bool wrote = false;            ///< -o has
    bool differs = false;          ///< a --diff has failed
    bool aborted = false;          ///< by an error
    bool misused = false;          ///< --compat: cannot be taken apart, --help is the answer
    int errors = 0, warnings = 0, failures = 0;
    std::string first_error;
    Strings warning_texts;

    std::string unused_limit; ///< an option that set a limit which no --diff has looked at yet
    std::set<std::string> matched_channels; ///< those of -d CHAN=TYPE that some output had
    Strings claimed;                        ///< files that this frame writes
    std::map<std::string, double> seconds;  ///< that commands took, for --runstats

    void note_error(const std::string& text, bool ends) {
        ++errors;
        aborted |= ends;
        if (first_error.empty())
            first_error = text;
    }

    /// 1 any error, 3 a threshold exceeded, 2 only warnings and --warnings-exit, else 0.
    int exit_status(const Settings& settings) const {
        if (errors > 0 || differs)
            return 1;
        if (failures > 0)
            return settings.compat ? 1 : 3;
        return warnings > 0 && settings.warnings_exit ? 2 : 0;
    }
};

} // namespace tonetool::chain
