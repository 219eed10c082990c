// SPDX-License-Identifier: BSD-3-Clause
// The part of a session that collects the results of a check.
#pragma once

#include "chain/session/session.h"
#include "sequence/report/report_store.h"
#include "sequence/results/results.h"
#include "sequence/results/shot_exposures.h"

namespace tonetool::chain {

struct CheckPart {
    sequence::FrameResult* result = nullptr;   ///< collects the measurements of commands
    sequence::FramePainter* painter = nullptr; ///< with a report: draws its images
    /// The range of exposures=shot or of a file; while the range is still being measured, the place
    /// for the frame's sample.
    const sequence::ShotExposures* shot = nullptr;
    sequence::ExposureSample* sample = nullptr;
};

// The check that a session is part of; nullptr without one.
inline sequence::FrameResult* result_of(const chain::Session& session) {
    return session.check ? session.check->result : nullptr;
}
inline sequence::FramePainter* painter_of(const chain::Session& session) {
    return session.check ? session.check->painter : nullptr;
}

} // namespace tonetool::chain
