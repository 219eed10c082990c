// SPDX-License-Identifier: BSD-3-Clause
// The check: what is wrong with a frame is its result.
#pragma once

#include <optional>
#include <vector>

#include "runs/frame_context.h"
#include "sequence/report/case_images.h"
#include "sequence/report/report_store.h"

namespace tonetool::runs {

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
