// SPDX-License-Identifier: BSD-3-Clause
#include "runs/checked_frames.h"

#include <algorithm>
#include <ostream>
#include <sstream>

#include "chain/session/runner.h"
#include "runs/check_end.h"
#include "runs/packed.h"
#include "runs/shots.h"
#include "sequence/frames/file_stamp.h"
#include "sequence/results/automatic_limits.h"
#include "sequence/results/probe.h"
#include "sequence/results/results_json.h"
#include "store/sha256.h"
#include "text/error.h"
#include "tonetool/write.h"

namespace tonetool::runs {

namespace {

using chain::Session;
using sequence::FrameResult;
using sequence::State;
using sequence::Status;

// What --qc and --against find is known when they have seen all frames.
std::string in_words(const FrameResult& result) {
    const bool open = !result.qc.empty() || !result.against.empty();
    const bool passed = result.status == Status::Passed;
    return status_name(open && passed ? Status::Measured : result.status) +
           (result.message.empty() ? "" : " (" + result.message + ")");
}

// Whether a command that draws a pair for the report runs whatever comes of the others.
bool draws_pairs(const chain::ParsedLine& line) {
    const auto is_of = [](const chain::Word& word, const Strings& names) {
        return word.row &&
               std::find(names.begin(), names.end(), word.row->names.front()) != names.end();
    };
    const auto any = [&](const Strings& names) {
        return std::any_of(line.words.begin(), line.words.end(),
                           [&](const chain::Word& word) { return is_of(word, names); });
    };
    return any({"hdrflip", "ldrflip", "flipdiff", "errormap", "biascheck"}) &&
           !any({"if", "while", "for"});
}

// A command after a comparison may find a fault or warn, and --qc and --against find more at the
// end.
bool may_fail_later(const FramePlan& plan) {
    bool compared = plan.check.has("qc") || plan.check.has("against"), more = compared;
    for (const chain::Word& word : plan.line.words) {
        more |= compared && (!word.row || !word.row->whole_line);
        compared |= word.row && word.row->group == chain::Group::Compare && word.row->pops > 0;
    }
    return more;
}

} // namespace

CheckedFrames::CheckedFrames(const FrameContext& context, const std::optional<State>& state,
                             sequence::PictureStore& pictures)
    : m_context(context),
      m_state(state),
      m_pictures(pictures),
      m_images(case_images(context.plan.check, context.plan.check.essence)),
      m_results(context.plan.runs.size()) {}

CheckedFrames::Checked CheckedFrames::not_checked(size_t index, Status status,
                                                  const std::string& why) const {
    Checked checked{unchecked_frame(m_context.plan, index), "", ""};
    checked.result.status = status;
    checked.result.message = why;
    if (status == Status::Skipped)
        return checked;
    std::ostringstream err;
    m_context.print_error(index, why, err);
    checked.err = err.str();
    checked.status = 1;
    return checked;
}

std::string CheckedFrames::approval_problem(const FrameRun& run) const {
    if (!run.of_suite.problem.empty() || run.of_suite.images.empty())
        return run.of_suite.problem;
    const store::Store approved = m_context.plan.suite->store();
    for (const store::ApprovedImage& image : run.of_suite.images) {
        std::string why = approved.problem(run.frame.name, image);
        if (!why.empty())
            return why;
    }
    return "";
}

CheckedFrames::Checked CheckedFrames::check(size_t index) const {
    const FramePlan& plan = m_context.plan;
    const FrameRun& run = plan.runs[index];
    Checked checked = plan.suite && plan.suite->has_store() ? check_approved(index)
                                                            : check_words(index, run.words);
    if (plan.suite && checked.result.status == Status::Failed)
        attribute(index, checked);
    write_images(checked);
    return checked;
}

// Whose error it is, of a case that failed: it is compared once more.
void CheckedFrames::attribute(size_t index, Checked& checked) const {
    const FramePlan& plan = m_context.plan;
    Strings words = plan.suite->attributing(plan.runs[index].words);
    if (words.empty())
        return;
    const FrameResult& first = checked.result;
    if (plan.suite->has_store()) // with the image that fits best
        words.at(plan.suite->reference_at()) = first.reference;
    Checked again = check_words(index, words);
    again.result.reference = first.reference;
    again.result.of_suite = first.of_suite;
    if (again.result.status == first.status) // and not where a layer cannot be read
        checked = std::move(again);
}

// With each of the images: the one that fits best is the result.
CheckedFrames::Checked CheckedFrames::check_approved(size_t index) const {
    const FrameRun& run = m_context.plan.runs[index];
    const SuitePlan& suite = *m_context.plan.suite;
    const store::Store approved = suite.store();
    const std::string test = run.words.at(suite.reference_at() + 1);
    const sequence::Stamp before = sequence::stamp_of(test);
    if (before.inode == 0)
        return check_words(index, run.words); // which says what is missing
    const std::string sha256 = store::sha256_of_file(test);
    std::optional<Checked> best;
    if (run.of_suite.images.empty()) { // nothing is approved
        const sequence::Probe probe = sequence::probed({test});
        if (!probe.message.empty())
            return not_checked(index, probe.status, probe.message);
        best = check_words(index, run.words);
    }
    std::vector<sequence::Tried> tried;
    const auto rank = [](const Checked& one) {
        return std::make_pair(one.result.status, badness(one.result));
    };
    for (const store::ApprovedImage& image : run.of_suite.images) {
        Strings words = run.words;
        words.at(suite.reference_at()) = approved.file(run.frame.name, image);
        Checked one = check_words(index, words);
        one.result.reference = words.at(suite.reference_at());
        one.result.of_suite.key = image.key;
        const bool better = !best || rank(one) < rank(*best);
        if (best) {
            const FrameResult& other = better ? best->result : one.result;
            tried.push_back({other.reference, status_name(other.status), badness(other)});
        }
        if (better)
            best = std::move(one);
    }
    best->result.of_suite.sha256 = sha256;
    best->result.of_suite.tried = std::move(tried);
    return sequence::stamp_of(test) == before
               ? std::move(*best)
               : not_checked(index, Status::Error,
                             "\"" + test + "\" has changed while it was checked");
}

CheckedFrames::Checked CheckedFrames::check_words(size_t index, const Strings& words) const {
    const FramePlan& plan = m_context.plan;
    const FrameRun& run = plan.runs[index];
    Checked checked{unchecked_frame(plan, index), "", ""};
    FrameResult& result = checked.result;
    std::ostringstream out, err;
    Session session = m_context.session(index, out, err);
    sequence::FramePainter painter{m_pictures, {}};
    painter.pair_comes = draws_pairs(plan.line_of(run));
    session.check.result = &result;
    sequence::CaseDrawing& drawing = checked.drawing;
    drawing.worst_asked = m_images.has_value();
    drawing.worst_always = may_fail_later(plan);
    drawing.first_asked = is_in_figure(index);
    drawing.stops = plan.check.figure.stops;
    painter.for_report = draws(plan.check);
    painter.beside = drawing.worst_asked || drawing.first_asked ? &drawing : nullptr;
    session.check.painter = painter.for_report || painter.beside ? &painter : nullptr;
    m_context.run_commands(session, index, words);
    result.warnings = session.outcome.warning_texts;
    if (session.outcome.warnings > int(result.warnings.size()))
        result.warnings.push_back("there were warnings, see what the frame printed");
    const std::string error = session.outcome.errors > 0 && session.outcome.first_error.empty()
                                  ? "the command line cannot be run"
                                  : session.outcome.first_error;
    sequence::settle(result, error, words_at(words, plan.check_of(run).inputs));
    if (result.status == Status::Missing && !run.absent.empty())
        result.message = run.absent;
    if (painter.drawn)
        checked.pictures = m_pictures.texts(result, *painter.drawn);
    if (drawing.first.test.initialized())
        checked.figure = sequence::figure_text(drawing.first);
    // Warnings are the verdict's matter: whether they count may differ when the result is found.
    const int status = session.exit_status();
    checked.status = status == 2 ? 0 : status;
    checked.out = out.str();
    checked.err = err.str();
    checked.files = session.files;
    checked.written = session.outcome.claimed;
    return checked;
}

// Rules over all frames find faults, and limits follow from them.
bool CheckedFrames::may_fail_at_end(const FrameResult& result) const {
    const CheckPlan& check = m_context.plan.check;
    return check.has("qc") || check.has("against") || sequence::has_automatic_limit(result);
}

bool CheckedFrames::is_in_figure(size_t index) const {
    const CheckPlan& check = m_context.plan.check;
    return check.has("figure") && !check.dry_run && check.figure.wants(m_context.item(index));
}

void CheckedFrames::write_images(Checked& checked) const {
    const FrameResult& result = checked.result;
    const sequence::CaseDrawing& drawing = checked.drawing;
    const bool wanted = m_images && drawing.worst.test.initialized() &&
                        (m_images->wants(result.status) || may_fail_at_end(result));
    try {
        if (wanted)
            m_images->write(result, drawing.worst);
    } catch (const std::exception& problem) {
        checked.unkept = std::string("--images: ") + problem.what();
    }
}

// What an earlier run has kept, with the pictures where there are to be some.
std::optional<CheckedFrames::Checked> CheckedFrames::find(size_t index) const {
    auto kept = m_state->find(m_context.item(index), origin(index));
    if (!kept || is_in_figure(index))
        return std::nullopt;
    FrameResult found = sequence::frame_from_json(kept->result);
    if (draws(m_context.plan.check) && !m_pictures.restore(found))
        return std::nullopt;
    if (m_images && m_images->wants(found.status) && !m_images->has(found))
        return std::nullopt;
    return Checked{
        std::move(found),        std::move(kept->out), std::move(kept->err), kept->status, true,
        std::move(kept->written)};
}

CheckedFrames::Checked CheckedFrames::check_or_find(size_t index) const {
    const FrameRun& run = m_context.plan.runs[index];
    if (!run.of_suite.skip.empty())
        return not_checked(index, Status::Skipped, run.of_suite.skip);
    if (const std::string why = approval_problem(run); !why.empty())
        return not_checked(index, Status::Error, why);
    if (!m_state)
        return check(index);
    if (auto found = find(index))
        return std::move(*found);
    Checked made = check(index);
    if (made.result.status <= Status::SizeMismatch) {
        const std::string error = keep_in(
            *m_state, m_context.item(index), origin(index), made.files,
            {sequence::to_json(made.result), made.out, made.err, made.status, made.written});
        if (!error.empty() && made.unkept.empty())
            made.unkept = "--state: " + error;
    }
    return made;
}

sequence::Origin CheckedFrames::origin(size_t index) const {
    const FrameRun& run = m_context.plan.runs[index];
    Strings words = words_at(run.words, m_context.plan.check_of(run).essence_at);
    for (const store::ApprovedImage& image : run.of_suite.images)
        words.push_back(image.sha256);
    std::string rest = m_context.shot ? sequence::exposures_text(*m_context.shot) : "";
    for (const auto& [at, light] : m_context.lights.measured)
        rest += shot_text(light);
    return {words, rest};
}

std::string CheckedFrames::kept() const {
    return kept_in(m_state, m_context.plan,
                   [this](size_t index) { return find(index).has_value(); });
}

Ran CheckedFrames::run(size_t index, std::ostream& out, std::ostream& err) {
    const Checked checked = check_or_find(index);
    out << checked.out;
    err << checked.err;
    const sequence::PictureTexts pictures = checked.pictures.value_or(sequence::PictureTexts{});
    return {checked.status, in_words(checked.result), false,
            packed({sequence::to_json(checked.result), checked.known ? "known" : "",
                    packed({pictures.begin(), pictures.end()}), packed(checked.written),
                    checked.unkept, checked.figure})};
}

Ran CheckedFrames::failed(size_t index, Status status, const std::string& why, std::ostream& err) {
    FrameResult result = unchecked_frame(m_context.plan, index);
    result.status = status;
    result.message = status == Status::Crashed ? crashed(why) : why;
    m_context.print_error(index, result.message, err);
    return {1, in_words(result), false,
            packed({sequence::to_json(result), "", "", packed({}), "", ""})};
}

void CheckedFrames::claim(const Strings& written, FrameResult& result, Ran& ran) const {
    if (m_context.plan.line.compat)
        return;
    try {
        for (const std::string& file : written)
            m_context.written->claim(file, result.item());
    } catch (const CommandError& problem) {
        result.status = Status::Error;
        result.message = problem.what();
        ran.status = 1;
        ran.words = in_words(result);
    }
}

void CheckedFrames::take(size_t index, Ran& ran) {
    Strings texts = unpacked(ran.found, 6);
    m_unkept = m_unkept.empty() ? texts[4] : m_unkept;
    FrameResult& result = m_results[index];
    result = sequence::frame_from_json(texts[0]);
    result.name = m_context.plan.runs[index].frame.name; // to the byte, whatever JSON makes of it
    result.method = m_context.plan.runs[index].frame.method;
    // As the suite has it now, if the result was found.
    const sequence::SuiteCase said = unchecked_frame(m_context.plan, index).of_suite;
    result.of_suite.check = said.check;
    result.of_suite.line = said.line;
    result.of_suite.why = said.why;
    claim(unpacked(texts[3]), result, ran);
    if (!texts[5].empty())
        m_pictures.keep_figure(result.item(), std::move(texts[5]));
    if (result.status == Status::Crashed) {
        // What the process had begun to write.
        remove_abandoned_outputs(
            words_at(m_context.plan.runs[index].words, m_context.plan.check.outputs));
        if (m_images)
            remove_abandoned_outputs(m_images->files(result).all());
    }
    if (!draws(m_context.plan.check))
        return;
    Strings drawn = unpacked(texts[2]);
    drawn.resize(sequence::kPictureSizes);
    sequence::PictureTexts pictures;
    std::move(drawn.begin(), drawn.end(), pictures.begin());
    keep_pictures(!texts[1].empty(), pictures, result);
}

void CheckedFrames::keep_pictures(bool known, const sequence::PictureTexts& texts,
                                  const FrameResult& result) {
    try {
        if (known)
            m_pictures.restore(result);
        else if (!texts[size_t(sequence::PictureSize::Small)].empty())
            m_pictures.add(result, texts);
        else
            m_pictures.forget(result);
    } catch (const std::exception& problem) {
        m_unkept = m_unkept.empty() ? problem.what() : m_unkept;
    }
}

} // namespace tonetool::runs
