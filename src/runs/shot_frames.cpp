// SPDX-License-Identifier: BSD-3-Clause
#include "runs/shot_frames.h"

#include <algorithm>
#include <sstream>

#include "chain/session/runner.h"
#include "runs/frame_context.h"
#include "sequence/frames/file_sequence.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

// A frame and those about it: four to each side.
constexpr size_t kLookedAt = 9;

// The run of another frame, also of one that --frames leaves out.
FrameRun run_of(const FramePlan& plan, size_t index, int number) {
    const FrameRun& own = plan.runs[index];
    for (const FrameRun& run : plan.runs)
        if (run.frame.number == number && run.frame.view == own.frame.view)
            return run;
    FrameRun run = own;
    run.frame.number = number;
    for (const size_t at : own.frame.varying) {
        const std::string& pattern = plan.line.texts[at];
        const auto named = [&](const Frame& frame) {
            return sequence::input_names(pattern, plan.options, {frame.item()}).at(0);
        };
        // A sequence that is paired by position has other numbers.
        if (sequence::has_range(pattern) || named(own.frame) != own.words[at])
            throw CommandError("frame " + std::to_string(number) + ", which steady=1 needs: \"" +
                               pattern +
                               "\" does not tell its name (valid: --frames with it, "
                               "or a pattern without a range of its own)");
        run.words[at] = named(run.frame);
    }
    return run;
}

chain::ShotFrame made(const FrameContext& context, size_t index, size_t at, int number) {
    const FrameRun run = run_of(context.plan, index, number);
    std::ostringstream out, err;
    chain::Session session = context.session(index, out, err);
    session.frame = run.frame;
    session.settings.dry_run = true;
    chain::ShotFrame found;
    session.shot.at = at;
    session.shot.frame = &found;
    chain::Runner(session, run.words).run_all();
    if (!found.frame)
        throw CommandError("frame " + std::to_string(number) + ", which steady=1 needs: " +
                           (session.outcome.first_error.empty() ? "it does not come to this command"
                                                                : session.outcome.first_error) +
                           " (valid: all frames that the statistics of the shot name, or "
                           "statistics without it)");
    found.files = session.files.names();
    return found;
}

} // namespace

chain::ShotFrame ShotFrames::find(const FrameContext& context, size_t index, size_t at,
                                  int number) {
    const Key key{at, context.plan.runs[index].frame.view, number};
    std::promise<chain::ShotFrame> promise;
    std::shared_future<chain::ShotFrame> frame;
    bool own = false;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        Kept& kept = m_kept[key];
        own = !kept.frame.valid();
        if (own)
            kept.frame = promise.get_future().share();
        kept.used = ++m_clock;
        frame = kept.frame;
        forget(kLookedAt - 1 + size_t(std::max(1, context.plan.parallel)), key);
    }
    if (own) {
        try {
            promise.set_value(made(context, index, at, number));
        } catch (...) {
            promise.set_exception(std::current_exception());
        }
    }
    return frame.get();
}

// The frames of this place and view that were not used for the longest time.
void ShotFrames::forget(size_t keep, const Key& key) {
    const auto same = [&](const Key& other) {
        return std::get<0>(other) == std::get<0>(key) && std::get<1>(other) == std::get<1>(key);
    };
    for (;;) {
        size_t count = 0;
        auto oldest = m_kept.end();
        for (auto one = m_kept.begin(); one != m_kept.end(); ++one) {
            if (!same(one->first))
                continue;
            ++count;
            if (oldest == m_kept.end() || one->second.used < oldest->second.used)
                oldest = one;
        }
        if (count <= keep)
            return;
        m_kept.erase(oldest);
    }
}

} // namespace tonetool::runs
