// What --qc measured of a frame, and what was asked, as the text of FrameResult::qc.
#pragma once

#include <string>

#include "sequence/qc/qc_limits.h"
#include "tonetool/qc.h"

namespace tonetool::sequence {

struct QcRecord {
    QcFacts facts;
    QcLimits limits;
};

/// One line of JSON. What it says comes back to the bit; bytes that are no UTF-8 become U+FFFD.
std::string to_json(const QcRecord& record);
/// A runtime_error for text that is no such record.
QcRecord qc_from_json(const std::string& text);

} // namespace tonetool::sequence
