// SPDX-License-Identifier: BSD-3-Clause
// Frames of a shot as a command needs them to make another one of them (steady=1).
#pragma once

#include <cstdint>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <tuple>

#include "chain/session/session.h"
#include "runs/frames.h"

namespace tonetool::runs {

struct FrameContext;

/// Keeps as many frames as the frames that run at a time look at, so that each is read once and not
/// for all frames about it. Frames may run on threads.
class ShotFrames {
public:
    /// What the command at this place of the line needs of the frame with this number and the view
    /// of run `index`; it may be a frame beyond --frames, whose files the patterns name. A
    /// CommandError where it cannot be made.
    chain::ShotFrame find(const FrameContext& context, size_t index, size_t at, int number);

private:
    using Key = std::tuple<size_t, std::string, int>; ///< place, view, number
    struct Kept {
        std::shared_future<chain::ShotFrame> frame;
        uint64_t used = 0;
    };

    void forget(size_t keep, const Key& key);

    std::mutex m_mutex;
    std::map<Key, Kept> m_kept;
    uint64_t m_clock = 0;
};

} // namespace tonetool::runs
