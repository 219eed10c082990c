// SPDX-License-Identifier: BSD-3-Clause
// The facts that --qc measured of a frame and the limits it was given, as the text of
// FrameResult::qc.
#pragma once

#include <string>

#include "sequence/frames/stray_files.h"
#include "sequence/qc/qc_rules.h"
#include "tonetool/qc.h"

namespace tonetool::sequence {

struct QcRecord {
    QcFacts facts;
    FaultLimits limits{qc_rules()};
    StrayFiles strays{}; ///< of the frame of a sequence
};

/// One line of JSON. Numbers are read back to the bit; invalid UTF-8 becomes U+FFFD.
std::string to_json(const QcRecord& record);
/// Throws a runtime_error for text that is not such a record.
QcRecord qc_from_json(const std::string& text);

} // namespace tonetool::sequence
