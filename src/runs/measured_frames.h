// SPDX-License-Identifier: BSD-3-Clause
// What is measured of each frame before the frames run.
#pragma once

#include <optional>
#include <vector>

#include "runs/frame_context.h"
#include "tonetool/shot.h"

namespace tonetool::runs {

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

} // namespace tonetool::runs
