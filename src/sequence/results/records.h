// SPDX-License-Identifier: BSD-3-Clause
// The records of --qc in the JSON of a check as texts: most of its bytes, which are neither taken
// apart nor kept as values where frames are only passed on.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tonetool::sequence {

/// A JSON text of a check whose frames have indices in place of their records.
struct WithoutRecords {
    std::string text;
    std::vector<std::string> records; ///< a line of JSON each
};

/// Takes the values of "qc" out of the frames. nullopt where brackets do not match: who reads the
/// whole text says what is wrong. What a value holds is not looked at.
std::optional<WithoutRecords> without_records(const std::string& text);

/// A text of JSON, laid out as all our files are: each value on its own line, which
/// begins with as many spaces as it is deep. `depth`: that of the line itself.
std::string laid_out(const std::string& line, size_t depth);

} // namespace tonetool::sequence
