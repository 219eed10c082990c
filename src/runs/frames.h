// SPDX-License-Identifier: BSD-3-Clause
// The frame loop: a command line with wildcards is run once for each frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chain/language/line.h"
#include "chain/session/session.h"
#include "runs/check_plan.h"
#include "runs/suite_plan.h"
#include "sequence/frames/file_sequence.h"
#include "text/text.h"

namespace tonetool::runs {

using chain::Frame;

/// One run of the command line, its wildcards replaced.
struct FrameRun {
    Strings words;
    Frame frame;
    /// The number of its second sequence where that is paired by position and has another.
    std::optional<int> test_frame{};
    /// Of a named case that a side lacks: what is said of it.
    std::string absent{};
    SuiteCasePlan of_suite{};
};

/// What the whole command line says about its frames.
struct FramePlan {
    chain::ParsedLine line;
    std::vector<FrameRun> runs; ///< one, where there is nothing to loop over
    bool loops = false;
    bool named = false; ///< its runs are cases with names
    bool skip_bad = false, verbose = false, quiet = false, warnings_exit = false;
    int parallel = 1;
    std::string progress; ///< "json", or "" for a terminal
    CheckPlan check;
    std::vector<size_t> sequences;     ///< of a check: indices of the input words with wildcards
    sequence::PatternOptions options;  ///< how names are taken apart
    std::shared_ptr<SuitePlan> suite;  ///< of --suite
    std::vector<std::string> warnings; ///< of the line, not of a frame
    size_t cases = 0;                  ///< that there are, where --only chose some of them

    /// Those of a run: a suite has cases whose check is another.
    const chain::ParsedLine& line_of(const FrameRun& run) const {
        return run.of_suite.own ? run.of_suite.own->line : line;
    }
    const CheckPlan& check_of(const FrameRun& run) const {
        return run.of_suite.own ? run.of_suite.own->check : check;
    }
};

/// What holds for the whole line, also before its word is reached.
void set_for_line(chain::Session& session, const FramePlan& plan);

/// A CommandError where sequences do not fit together or match no file.
/// `directory` is that of relative file names; empty: the current one. `for_images`: the line is
/// run for one frame's images, and judges nothing.
FramePlan plan_frames(chain::ParsedLine line, const std::string& directory = "",
                      bool for_images = false);

} // namespace tonetool::runs
