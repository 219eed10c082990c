// SPDX-License-Identifier: BSD-3-Clause
// What the frames of a plan have in common, and a frame whose commands are run plainly.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "chain/session/session.h"
#include "runs/loop.h"
#include "runs/shot_frames.h"
#include "sequence/results/shot_exposures.h"
#include "sequence/results/state.h"

namespace tonetool::runs {

/// What the frames of a plan have in common.
struct FrameContext {
    const FramePlan& plan;
    std::optional<sequence::ShotExposures> shot; ///< of exposures=
    chain::ShotPart lights{};                    ///< of adapt=
    std::shared_ptr<ShotFrames> frames = std::make_shared<ShotFrames>();
    std::shared_ptr<chain::WrittenFiles> written = std::make_shared<chain::WrittenFiles>();

    chain::Session session(size_t index, std::ostream& out, std::ostream& err) const;
    sequence::Item item(size_t index) const;
    /// Runs the words of the frame, if its files are there.
    void run_commands(chain::Session& session, size_t index, const Strings& words) const;
    std::string absent_approved(const chain::Session& session, const Strings& files) const;
    /// Whether the folder of the approved version has earlier and later frames than this one.
    bool is_between_approved(size_t index) const;
    /// Prints what ended the run of a frame, as its commands' errors are printed.
    void print_error(size_t index, const std::string& error, std::ostream& err) const;
};

/// The result of a frame before anything is known of it.
sequence::FrameResult unchecked_frame(const FramePlan& plan, size_t index);

/// Keeps what was found of a frame. What is wrong with the folder of the state, or "": what was
/// measured is right all the same.
std::string keep_in(const sequence::State& state, const sequence::Item& item,
                    const sequence::Origin& origin, const sequence::FileLog& files,
                    const sequence::Kept& found);
/// "19 of 24 frames kept in st"; empty without a state.
std::string kept_in(const std::optional<sequence::State>& state, const FramePlan& plan,
                    const std::function<bool(size_t)>& is_kept);
/// What is said of a frame whose process ended.
std::string crashed(const std::string& how);

/// A frame whose commands do what they do.
class PlainFrames final : public FrameJob {
public:
    explicit PlainFrames(const FrameContext& context) : m_context(context) {}
    Ran run(size_t index, std::ostream& out, std::ostream& err) override;
    Ran failed(size_t index, sequence::Status status, const std::string& why,
               std::ostream& err) override;
    void take(size_t, Ran&) override {}

private:
    const FrameContext& m_context;
};

} // namespace tonetool::runs
