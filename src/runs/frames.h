// The frame loop: a command line with wildcards is run once for each frame.
#pragma once

#include <OpenImageIO/timer.h>
#include <string>
#include <vector>

#include "chain/session.h"
#include "runs/check_plan.h"
#include "text/text.h"

namespace tonetool::runs {

using chain::Frame;

/// One run of the command line, its wildcards replaced.
struct FrameRun {
    Strings words;
    Frame frame;
};

/// What the whole command line says about its frames.
struct FramePlan {
    std::vector<FrameRun> runs; ///< one, where there is nothing to loop over
    bool loops = false;
    bool compat = false, skip_bad = false, verbose = false, warnings_exit = false;
    int parallel = 1;
    std::string progress; ///< "json", or "" for a terminal
    CheckPlan check;
    std::vector<size_t> sequences; ///< of a check: indices of the input words with wildcards
};

/// --compat holds for the whole command line.
bool is_compat(const Strings& words);

/// The words for messages and outputs, quoted as a shell wants them unless `compat`.
std::string full_command_line(const Strings& words, bool compat);

/// A CommandError where sequences do not fit together or match no file.
/// `directory` is that of relative file names; empty: the current one.
FramePlan plan_frames(const Strings& words, const std::string& directory = "");

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
