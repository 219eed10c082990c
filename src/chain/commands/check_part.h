// Where the commands of a check put what they find.
#pragma once

#include "chain/session/session.h"
#include "sequence/report/report_store.h"
#include "sequence/results/results.h"
#include "sequence/results/shot_exposures.h"

namespace tonetool::chain {

struct CheckPart {
    sequence::FrameResult* result = nullptr;   ///< gathers what commands measure
    sequence::FramePainter* painter = nullptr; ///< with a report: what it shows
    /// The range of exposures=shot or of a file; while that is still measured, where to.
    const sequence::ShotExposures* shot = nullptr;
    sequence::ExposureSample* sample = nullptr;
};

// Of the check that a session is part of; nullptr without one.
inline sequence::FrameResult* result_of(const chain::Session& session) {
    return session.check ? session.check->result : nullptr;
}
inline sequence::FramePainter* painter_of(const chain::Session& session) {
    return session.check ? session.check->painter : nullptr;
}

} // namespace tonetool::chain
