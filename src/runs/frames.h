// The frame loop: a command line with wildcards is run once for each frame.
#pragma once

#include <OpenImageIO/timer.h>
#include <optional>
#include <string>
#include <vector>

#include "chain/session/session.h"
#include "runs/check_plan.h"
#include "text/text.h"

namespace tonetool::runs {

using chain::Frame;

/// One run of the command line, its wildcards replaced.
struct FrameRun {
    Strings words;
    Frame frame;
    /// The number of its second sequence where that is paired by position and has another.
    std::optional<int> test_frame{};
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

/// A word of a command line that stands for itself: a command, known or not, or a file.
struct LeadWord {
    size_t at = 0;
    bool is_command = false; ///< has a dash, and no other command takes it as its argument
    const chain::Command* row = nullptr;
    std::vector<size_t> arguments{}; ///< the words that it takes
};
std::vector<LeadWord> lead_words(const Strings& words);
/// Which words are commands.
std::vector<bool> commands_among(const Strings& words);

/// "--frames=1-3" as "--frames", "1-3": of what says which frames, how many at a time and where
/// results go.
Strings with_values_apart(const Strings& words);

/// --compat, or -compat, holds for the whole command line.
bool is_compat(const Strings& words);

/// The words for messages and outputs, quoted as a shell wants them unless `compat`.
std::string full_command_line(const Strings& words, bool compat);

/// A CommandError where sequences do not fit together or match no file.
/// `directory` is that of relative file names; empty: the current one. `for_images`: the line is
/// run for one frame's images, and judges nothing.
FramePlan plan_frames(const Strings& words, const std::string& directory = "",
                      bool for_images = false);

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
