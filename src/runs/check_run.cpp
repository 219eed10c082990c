#include "runs/check_run.h"

#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>

#include "chain/runner.h"
#include "include/tonetool/write.h"
#include "manual/help.h"
#include "measure/check_part.h"
#include "runs/check_end.h"
#include "runs/loop.h"
#include "sequence/check_files.h"
#include "sequence/probe.h"
#include "sequence/qc.h"
#include "sequence/report_store.h"
#include "sequence/results_json.h"
#include "sequence/shot_exposures.h"
#include "sequence/state.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

using chain::Runner;
using chain::Session;

using sequence::FrameResult;
using sequence::Kept;
using sequence::State;
using sequence::Status;

sequence::Item item_of(const FrameRun& run) {
    return {run.frame.number, run.frame.view};
}

std::string in_words(const FrameResult& result) {
    return status_name(result.status) + (result.message.empty() ? "" : " (" + result.message + ")");
}

// Of what one comparison alone would take, half of the computer's memory; --memory says otherwise.
uint64_t share_of_memory(int parallel) {
    constexpr uint64_t enough = uint64_t(1) << 29;
    return parallel < 2
               ? 0
               : std::max(enough, OIIO::Sysutil::physical_memory() / 2 / uint64_t(parallel));
}

class PlanRun {
public:
    PlanRun(FramePlan& plan, std::ostream& out, std::ostream& err)
        : m_plan(plan),
          m_out(out),
          m_err(err) {}

    int run();

private:
    using Body = Ran (PlanRun::*)(size_t index, std::ostream& out, std::ostream& err);
    int loop(std::ostream& out, std::ostream& err, Body body, bool goes_on);
    Session session_of(const FrameRun& run, std::ostream& out, std::ostream& err) const;
    void run_commands(Session& session, const FrameRun& run) const;
    measure::CheckPart shot_part() const {
        measure::CheckPart part;
        part.shot = m_shot ? &*m_shot : nullptr;
        return part;
    }

    Ran plain(size_t index, std::ostream& out, std::ostream& err);
    Ran sample(size_t index, std::ostream& out, std::ostream& err);
    Ran check(size_t index, std::ostream& out, std::ostream& err);

    int find_exposures();
    void prepare();
    void remove_abandoned() const;
    Kept check_anew(const FrameRun& run, FrameResult& result) const;
    Kept check_or_find(const FrameRun& run, FrameResult& result) const;

    FramePlan& m_plan;
    std::ostream& m_out;
    std::ostream& m_err;
    std::optional<sequence::ShotExposures> m_shot;
    std::vector<std::optional<sequence::ExposureSample>> m_samples;
    Strings m_sample_errors; ///< by frame, for threads' sake
    std::vector<FrameResult> m_results;
    std::optional<State> m_state, m_sample_state;
    std::unique_ptr<sequence::PictureStore> m_pictures;
};

int PlanRun::run() {
    const CheckPlan& check = m_plan.check;
    prepare();
    const int found = find_exposures();
    if (check.has("statistics")) {
        return found;
    }
    if (!check.is_check()) {
        return loop(m_out, m_err, &PlanRun::plain, m_plan.skip_bad);
    }
    m_results.resize(m_plan.runs.size());
    const int status = loop(m_out, m_err, &PlanRun::check, true);
    sequence::ShotResult shot{check.essence, m_shot, std::move(m_results), {}, {}, {}};
    conclude(shot);
    return worse(status, conclude_check(shot, m_plan, *m_pictures, m_out));
}

void PlanRun::prepare() {
    const CheckPlan& check = m_plan.check;
    sequence::check_places(check.words);
    if (check.has("state")) {
        m_state.emplace(check.argument("state"), "frame");
        m_sample_state.emplace(check.argument("state"), "exposures");
    }
    m_pictures = std::make_unique<sequence::PictureStore>(picture_folder(check));
    if (m_state) {
        remove_abandoned();
    }
}

void PlanRun::remove_abandoned() const {
    const CheckPlan& check = m_plan.check;
    Strings files;
    for (const auto& word : check.words) {
        if (!word.second.empty()) {
            files.push_back(word.second);
        }
    }
    for (const FrameRun& run : m_plan.runs) {
        const Strings outputs = words_at(run.words, check.outputs);
        files.insert(files.end(), outputs.begin(), outputs.end());
        files.push_back(m_state->file(item_of(run)));
        files.push_back(m_sample_state->file(item_of(run)));
        const Strings drawn = m_pictures->files(run.frame.number, run.frame.view);
        files.insert(files.end(), drawn.begin(), drawn.end());
    }
    remove_abandoned_outputs(files);
}

int PlanRun::loop(std::ostream& out, std::ostream& err, Body body, bool goes_on) {
    const auto run = [&](size_t index, std::ostream& to, std::ostream& errors) {
        return (this->*body)(index, to, errors);
    };
    return Loop(m_plan, out, err, run, goes_on).run();
}

Session PlanRun::session_of(const FrameRun& run, std::ostream& out, std::ostream& err) const {
    Session session(out, err, full_command_line(run.words, m_plan.compat));
    session.compat = m_plan.compat;
    session.frame = run.frame;
    session.in_all_frames = [this](size_t at) {
        Strings names;
        for (const FrameRun& other : m_plan.runs) {
            names.push_back(other.words.at(at));
        }
        return names;
    };
    session.parallel = m_plan.parallel;
    session.memory = share_of_memory(m_plan.parallel);
    return session;
}

void PlanRun::run_commands(Session& session, const FrameRun& run) const {
    const sequence::Probe gone = sequence::missing_of(words_at(run.words, m_plan.sequences));
    if (gone.status == Status::Missing) {
        session.error("", gone.message);
    } else {
        Runner(session, run.words).run_all();
        if (session.misused) {
            session.out << manual::help_text();
        }
    }
}

Ran PlanRun::plain(size_t index, std::ostream& out, std::ostream& err) {
    Session session = session_of(m_plan.runs[index], out, err);
    measure::CheckPart part = shot_part();
    session.check = &part;
    run_commands(session, m_plan.runs[index]);
    static const char* const words[] = {"done", "error", "warnings", "a threshold was exceeded"};
    const int status = session.exit_status();
    return {status, words[status], session.aborted};
}

// ---- exposures of the shot

Ran PlanRun::sample(size_t index, std::ostream&, std::ostream& err) {
    const FrameRun& run = m_plan.runs[index];
    const Strings words = words_at(run.words, m_plan.check.essence_at);
    const sequence::Origin origin{words, "exposures", {}};
    const std::string key =
        m_sample_state ? State::key({words, "exposures", words_at(run.words, m_plan.check.outputs)})
                       : "";
    std::optional<Kept> kept =
        m_sample_state ? m_sample_state->find(item_of(run), key) : std::nullopt;
    if (kept) {
        m_samples[index] = sequence::samples_from_json(kept->result).at(0);
        return {0, "exposures"};
    }
    sequence::ExposureSample found{run.frame.number, run.frame.view, -1, 0};
    std::ostringstream nowhere;
    Session session = session_of(run, nowhere, err);
    measure::CheckPart part = shot_part();
    part.sample = &found;
    session.check = &part;
    session.dry_run = true;
    run_commands(session, run);
    if (session.errors > 0 || found.max_luminance < 0) {
        m_sample_errors[index] = session.first_error;
        return {1, "no exposures"};
    }
    m_samples[index] = found;
    if (m_sample_state) {
        m_sample_state->keep(item_of(run), key, origin, {sequence::to_json({found}), "", "", 0});
    }
    return {0, "exposures"};
}

int PlanRun::find_exposures() {
    const std::string& from = m_plan.check.exposures;
    if (from != "shot") {
        if (!from.empty()) {
            m_shot = sequence::read_exposures(from);
        }
        return 0;
    }
    // What cannot be read is told by the frames' own runs, if there are any.
    const bool alone = m_plan.check.has("statistics");
    std::ostringstream nowhere;
    m_samples.resize(m_plan.runs.size());
    m_sample_errors.resize(m_plan.runs.size());
    const int status = loop(m_out, alone ? m_err : nowhere, &PlanRun::sample, true);
    sequence::ExposureSamples samples;
    for (const auto& found : m_samples) {
        if (found) {
            samples.push_back(*found);
        }
    }
    if (alone) {
        sequence::write_text(sequence::to_json(samples), m_plan.check.argument("statistics"));
        return status;
    }
    const Strings& errors = m_sample_errors;
    const auto first = std::find_if(errors.begin(), errors.end(),
                                    [](const std::string& error) { return !error.empty(); });
    if (samples.empty() && first != errors.end()) {
        throw CommandError("no exposures of the shot: " + *first);
    }
    m_shot = sequence::shot_exposures(samples);
    return 0;
}

// ---- the check

Kept PlanRun::check_anew(const FrameRun& run, FrameResult& result) const {
    std::ostringstream out, err;
    Session session = session_of(run, out, err);
    sequence::FramePainter painter{*m_pictures, {}};
    measure::CheckPart part = shot_part();
    part.result = &result;
    part.painter = draws(m_plan.check) ? &painter : nullptr;
    session.check = &part;
    run_commands(session, run);
    result.warnings = session.warning_texts;
    if (session.warnings > int(result.warnings.size())) {
        result.warnings.push_back("there were warnings, see what the frame printed");
    }
    const std::string error = session.errors > 0 && session.first_error.empty()
                                  ? "the command line cannot be run"
                                  : session.first_error;
    sequence::settle(result, error, words_at(run.words, m_plan.check.inputs));
    if (painter.drawn) {
        m_pictures->add(result, *painter.drawn);
    } else {
        m_pictures->forget(result);
    }
    // Warnings are the verdict's matter: whether they count may differ when the result is found.
    const int status = session.exit_status();
    return {sequence::to_json(result), out.str(), err.str(), status == 2 ? 0 : status};
}

Kept PlanRun::check_or_find(const FrameRun& run, FrameResult& result) const {
    if (!m_state) {
        return check_anew(run, result);
    }
    const sequence::Origin origin{words_at(run.words, m_plan.check.essence_at),
                                  m_shot ? sequence::exposures_text(*m_shot) : "",
                                  words_at(run.words, m_plan.check.outputs)};
    const std::string key = State::key(origin);
    if (std::optional<Kept> kept = m_state->find(item_of(run), key)) {
        FrameResult found = sequence::frame_from_json(kept->result);
        if (!draws(m_plan.check) || m_pictures->restore(found)) {
            result = std::move(found);
            return *kept;
        }
    }
    Kept made = check_anew(run, result);
    if (result.status <= Status::SizeMismatch) {
        m_state->keep(item_of(run), key, origin, made);
    }
    return made;
}

Ran PlanRun::check(size_t index, std::ostream& out, std::ostream& err) {
    const FrameRun& run = m_plan.runs[index];
    FrameResult& result = m_results[index];
    result.frame = run.frame.number;
    result.view = run.frame.view;
    const Strings names =
        words_at(run.words, m_plan.sequences.empty() ? m_plan.check.inputs : m_plan.sequences);
    result.reference = names.size() > 1 ? names[0] : "";
    result.test = names.empty() ? "" : names[names.size() > 1 ? 1 : 0];
    const Kept kept = check_or_find(run, result);
    out << kept.out;
    err << kept.err;
    return {kept.status, in_words(result)};
}

} // namespace

int run_plan(const Strings& words, FramePlan plan, std::ostream& out, std::ostream& err) {
    return plan.check.has("merge") ? merge_parts(words, plan, out, err)
                                   : PlanRun(plan, out, err).run();
}

} // namespace tonetool::runs
