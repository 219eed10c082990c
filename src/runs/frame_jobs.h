// SPDX-License-Identifier: BSD-3-Clause
// What is done with each frame of a command line: run plainly, looked at for the exposures of the
// shot, or checked.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "chain/session/session.h"
#include "runs/loop.h"
#include "runs/shot_frames.h"
#include "sequence/report/case_images.h"
#include "sequence/report/report_store.h"
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
    /// Prints what ended the run of a frame, as its commands' errors are printed.
    void print_error(size_t index, const std::string& error, std::ostream& err) const;
};

/// The result of a frame before anything is known of it.
sequence::FrameResult unchecked_frame(const FramePlan& plan, size_t index);

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

/// Measures something of each frame before the frames run: a text of each, in the form that it has
/// in a file.
class MeasuredFrames : public FrameJob {
public:
    /// `what`: "exposures", as results are called. A state keeps them for the next run.
    MeasuredFrames(const FrameContext& context, std::string what,
                   const std::optional<sequence::State>* state = nullptr);
    Ran run(size_t index, std::ostream& out, std::ostream& err) final;
    Ran failed(size_t index, sequence::Status status, const std::string& why,
               std::ostream& err) final;
    void take(size_t index, Ran& ran) final;

    std::string kept() const final;

    /// Of the first frame that could not be measured; empty where all could.
    std::string first_error() const;
    /// Of a frame; empty where it could be measured.
    const std::string& error_of(size_t index) const { return m_errors[index]; }

protected:
    /// Of the frames that were measured, in their order.
    Strings texts() const;

private:
    // A frame's text, if it has any, and what was wrong with it.
    struct Measured {
        std::optional<std::string> text;
        std::string error;
    };
    Measured measure(size_t index, std::ostream& err) const;
    sequence::Origin origin(size_t index) const;
    bool keeps() const { return m_state && *m_state; }
    /// Runs the words of the frame in a session that is to measure; nothing if they have not.
    virtual std::optional<std::string> run_words(size_t index, chain::Session& session) const = 0;

    const FrameContext& m_context;
    std::string m_what;
    const std::optional<sequence::State>* m_state;
    std::vector<std::optional<std::string>> m_texts;
    Strings m_errors; ///< one for each frame
};

/// Measures what exposures=shot needs.
class ExposureFrames final : public MeasuredFrames {
public:
    ExposureFrames(const FrameContext& context, const std::optional<sequence::State>& state)
        : MeasuredFrames(context, "exposures", &state),
          m_context(context) {}
    sequence::ExposureSamples samples() const;

private:
    std::optional<std::string> run_words(size_t index, chain::Session& session) const override;

    const FrameContext& m_context;
};

/// Measures what adapt=shot needs, for one command; those before it have theirs.
class LightFrames final : public MeasuredFrames {
public:
    LightFrames(const FrameContext& context, size_t at)
        : MeasuredFrames(context, "light"),
          m_context(context),
          m_at(at) {}
    std::vector<FrameLight> lights() const;

private:
    std::optional<std::string> run_words(size_t index, chain::Session& session) const override;

    const FrameContext& m_context;
    size_t m_at;
};

/// Checks frames: what is wrong with one is its result.
class CheckedFrames final : public FrameJob {
public:
    CheckedFrames(const FrameContext& context, const std::optional<sequence::State>& state,
                  sequence::PictureStore& pictures);
    Ran run(size_t index, std::ostream& out, std::ostream& err) override;
    Ran failed(size_t index, sequence::Status status, const std::string& why,
               std::ostream& err) override;
    void take(size_t index, Ran& ran) override;

    std::string kept() const override;

    std::vector<sequence::FrameResult>& results() { return m_results; }
    /// Why something of the first such frame could not be kept for a later run or the report;
    /// results are not less right for that. Empty: all could.
    const std::string& unkept() const { return m_unkept; }

private:
    // A frame's result, what it has printed, and its pictures.
    struct Checked {
        sequence::FrameResult result;
        std::string out, err;
        int status = 0;
        bool known = false; ///< from an earlier run
        Strings written{};  ///< files, by its commands
        std::optional<sequence::PictureTexts> pictures{};
        sequence::FileLog files{}; ///< that its run has opened
        std::string figure{};      ///< its pictures in --figure
        sequence::CaseDrawing drawing{};
        std::string unkept{}; ///< why its result could not be kept for a later run
    };

    Checked check(size_t index) const;
    Checked check_words(size_t index, const Strings& words) const;
    Checked check_approved(size_t index) const;
    void attribute(size_t index, Checked& checked) const;
    Checked not_checked(size_t index, sequence::Status status, const std::string& why) const;
    // Why it cannot be compared with an image that was approved; empty: it can.
    std::string approval_problem(const FrameRun& run) const;
    std::optional<Checked> find(size_t index) const;
    Checked check_or_find(size_t index) const;
    sequence::Origin origin(size_t index) const;
    // Frames of several processes must not write one file either.
    void claim(const Strings& written, sequence::FrameResult& result, Ran& ran) const;
    bool may_fail_at_end(const sequence::FrameResult& result) const;
    void write_images(Checked& checked) const;
    // The case is in --figure, which is drawn of its images.
    bool is_in_figure(size_t index) const;

    const FrameContext& m_context;
    const std::optional<sequence::State>& m_state;
    sequence::PictureStore& m_pictures;
    void keep_pictures(bool known, const sequence::PictureTexts& texts,
                       const sequence::FrameResult& result);

    std::optional<sequence::CaseImages> m_images; ///< of --images
    std::vector<sequence::FrameResult> m_results;
    std::string m_unkept;
};

} // namespace tonetool::runs
