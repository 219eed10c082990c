// SPDX-License-Identifier: BSD-3-Clause
// What --against keeps of a frame, as the text of FrameResult::against.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sequence/against/against_rules.h"
#include "tonetool/against.h"

namespace tonetool::sequence {

/// A difference of the headers.
struct AgainstDifference {
    std::string code, layer, sentence;
    Severity severity = Severity::Error; ///< unless the user has set one
};

struct AgainstRecord {
    using Window = std::array<int, 4>;

    bool approved = true;           ///< the approved version has the frame
    bool between = false;           ///< it has not, but earlier and later ones
    Window approved_data{}, data{}; ///< data windows: x, y, width, height
    /// Hashes of depths and positions, which tell which frame of the other version it looks like.
    std::string approved_moment, moment;
    std::vector<AgainstDifference> differences;
    std::vector<AgainstLayer> layers;
    FaultLimits limits{against_rules()};
};

/// `headers`: names of attributes that must agree, beside those that always must.
AgainstRecord record_of(const AgainstFacts& facts, const std::vector<std::string>& headers);

/// One line of JSON. Numbers are read back to the bit; invalid UTF-8 becomes U+FFFD.
std::string to_json(const AgainstRecord& record);
/// Throws a runtime_error for text that is not such a record.
AgainstRecord against_from_json(const std::string& text);

} // namespace tonetool::sequence
