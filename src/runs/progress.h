// SPDX-License-Identifier: BSD-3-Clause
// What a person sees while frames run.
#pragma once

#include <OpenImageIO/timer.h>
#include <iosfwd>
#include <string>

#include "runs/frames.h"

namespace tonetool::runs {

/// Frames done, rate and time left: a line on a terminal, or a line for each frame.
class Progress {
public:
    Progress(std::ostream& stream, const FramePlan& plan);
    /// With the status in words, for -v.
    void done(const FrameRun& run, int status, const std::string& words, double seconds);

private:
    std::ostream& m_stream;
    bool m_json, m_terminal, m_verbose;
    size_t m_total, m_done = 0;
    OIIO::Timer m_time;
};

} // namespace tonetool::runs
