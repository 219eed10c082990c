// SPDX-License-Identifier: BSD-3-Clause
#include "runs/measured_frames.h"

#include <algorithm>
#include <ostream>
#include <sstream>

#include "runs/check_end.h"
#include "runs/packed.h"
#include "runs/shots.h"

namespace tonetool::runs {

using chain::Session;
using sequence::State;
using sequence::Status;

MeasuredFrames::MeasuredFrames(const FrameContext& context, std::string what,
                               const std::optional<State>* state)
    : m_context(context),
      m_what(std::move(what)),
      m_state(state),
      m_texts(context.plan.runs.size()),
      m_errors(context.plan.runs.size()) {}

MeasuredFrames::Measured MeasuredFrames::measure(size_t index, std::ostream& err) const {
    const sequence::Item item = m_context.item(index);
    if (keeps()) {
        if (auto kept = (*m_state)->find(item, origin(index)))
            return {std::move(kept->result), ""};
    }
    std::ostringstream nowhere;
    Session session = m_context.session(index, nowhere, err);
    session.settings.dry_run = true;
    const auto found = run_words(index, session);
    if (session.outcome.errors > 0 || !found)
        return {std::nullopt, session.outcome.first_error};
    Measured measured{found, ""};
    if (keeps()) {
        measured.error = keep_in(**m_state, item, origin(index), session.files, {*found, "", ""});
        if (!measured.error.empty())
            m_context.print_error(index, measured.error, err);
    }
    return measured;
}

Ran MeasuredFrames::run(size_t index, std::ostream&, std::ostream& err) {
    const Measured measured = measure(index, err);
    const bool found = measured.text.has_value();
    return {found && measured.error.empty() ? 0 : 1, (found ? "" : "no ") + m_what, false,
            packed({found ? *measured.text : "", measured.error})};
}

Ran MeasuredFrames::failed(size_t index, Status status, const std::string& why, std::ostream& err) {
    const std::string error = status == Status::Crashed ? crashed(why) : why;
    m_context.print_error(index, error, err);
    return {1, "no " + m_what, false, packed({"", error})};
}

void MeasuredFrames::take(size_t index, Ran& ran) {
    Strings texts = unpacked(ran.found, 2);
    if (!texts[0].empty())
        m_texts[index] = std::move(texts[0]);
    m_errors[index] = texts[1];
}

sequence::Origin MeasuredFrames::origin(size_t index) const {
    const FramePlan& plan = m_context.plan;
    return {words_at(plan.runs[index].words, plan.check.essence_at), m_what};
}

std::string MeasuredFrames::kept() const {
    if (!keeps())
        return "";
    return "the " + m_what + " of " + kept_in(*m_state, m_context.plan, [this](size_t index) {
               return (*m_state)->find(m_context.item(index), origin(index)).has_value();
           });
}

Strings MeasuredFrames::texts() const {
    Strings all;
    for (const auto& found : m_texts)
        if (found)
            all.push_back(*found);
    return all;
}

std::string MeasuredFrames::first_error() const {
    const auto first = std::find_if(m_errors.begin(), m_errors.end(),
                                    [](const std::string& error) { return !error.empty(); });
    return first == m_errors.end() ? "" : *first;
}

std::optional<std::string> ExposureFrames::run_words(size_t index, Session& session) const {
    const Frame& frame = m_context.plan.runs[index].frame;
    sequence::ExposureSample found{frame.number, frame.view, -1, 0};
    session.check.sample = &found;
    m_context.run_commands(session, index, m_context.plan.runs[index].words);
    if (found.max_luminance < 0)
        return std::nullopt;
    return sequence::to_json({found});
}

sequence::ExposureSamples ExposureFrames::samples() const {
    sequence::ExposureSamples all;
    for (const std::string& text : texts())
        all.push_back(sequence::samples_from_json(text).at(0));
    return all;
}

// A frame that does not come to the command has no part in its shot.
std::optional<std::string> LightFrames::run_words(size_t index, Session& session) const {
    FrameLight light;
    session.shot.at = m_at;
    session.shot.light = &light;
    m_context.run_commands(session, index, m_context.plan.runs[index].words);
    return light.histogram.empty() ? std::nullopt : std::optional(shot_text({"shot", {light}}));
}

std::vector<FrameLight> LightFrames::lights() const {
    std::vector<FrameLight> all;
    for (const std::string& text : texts())
        all.push_back(shot_of_text(text).frames.at(0));
    return all;
}

} // namespace tonetool::runs
