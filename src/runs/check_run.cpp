// SPDX-License-Identifier: BSD-3-Clause
#include "runs/check_run.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>

#include "runs/check_end.h"
#include "runs/checked_frames.h"
#include "runs/interruption.h"
#include "runs/measured_frames.h"
#include "runs/rehearsal.h"
#include "runs/shots.h"
#include "runs/written_over.h"
#include "sequence/results/check_files.h"
#include "text/error.h"
#include "text/printable.h"
#include "tonetool/write.h"

namespace tonetool::runs {

namespace {

using sequence::State;

class PlanRun {
public:
    PlanRun(const FramePlan& plan, std::ostream& out, std::ostream& err, bool workers)
        : m_plan(plan),
          m_out(out),
          m_err(err),
          m_workers(workers),
          m_place(workers && plan.check.pairs_frames() ? Place::WorkerProcesses
                                                       : Place::ThisProcess) {}

    int run();

private:
    int loop(std::ostream& err, FrameJob& job, bool goes_on);
    void read_exposures();
    int find_exposures();
    bool measure_shots();
    std::vector<FrameLight> measure_shot(const ShotCommand& command, bool alone);
    void tell_unmeasured(const LightFrames& frames);
    void tell(const std::string& warning);
    int check();
    /// The line ends with a verdict of its frames.
    bool judges_frames() const {
        return m_plan.check.is_check() || (m_plan.loops && m_plan.check.has_verdict());
    }
    void prepare();
    void remove_abandoned() const;

    const FramePlan& m_plan;
    std::ostream& m_out;
    std::ostream& m_err;
    bool m_workers;
    Place m_place;
    int m_threads = 0;  ///< of --threads
    int m_measured = 0; ///< the status of what was measured before
    FrameContext m_context{m_plan, {}};
    std::optional<State> m_state, m_sample_state;
    std::vector<sequence::Acceptance> m_accepted; ///< of --accept
    std::unique_ptr<sequence::PictureStore> m_pictures;
};

int PlanRun::run() {
    sequence::check_places(m_plan.check.written_places());
    refuse_to_write_over(m_plan);
    check_cases_asked_for(m_plan);
    if (judges_frames())
        refuse_shot_against_itself(m_plan);
    m_accepted = accepted_by(m_plan.check, m_plan.check.essence);
    if (m_plan.check.only_validates || judges_frames()) {
        try_outputs(m_plan);
        if (!commands_are_right(m_plan, m_err, m_workers))
            return 1;
    }
    for (const std::string& warning : m_plan.warnings)
        tell(warning);
    if (m_plan.check.only_validates) {
        read_exposures();
        m_out << plan_text(m_plan);
        return 0;
    }
    prepare();
    const bool ended = measure_shots();
    const int found = ended ? m_measured : worse(m_measured, find_exposures());
    if (m_plan.check.has("statistics"))
        return found;
    if (judges_frames())
        return check();
    PlainFrames frames(m_context);
    return worse(m_measured, loop(m_err, frames, m_plan.skip_bad));
}

int PlanRun::check() {
    CheckedFrames frames(m_context, m_state, *m_pictures);
    const int status = loop(m_err, frames, true);
    // No process is made any more, and the report may have threads.
    if (m_threads > 0)
        OIIO::attribute("threads", m_threads);
    if (!m_plan.check.judges()) { // an --if may have left frames out
        auto& all = frames.results();
        all.erase(std::remove_if(all.begin(), all.end(), sequence::is_unmeasured), all.end());
        if (all.empty())
            return status;
    }
    sequence::ShotResult shot{
        m_plan.check.essence, m_context.shot, std::move(frames.results()), {}, {}, {}, m_accepted};
    if (m_plan.suite)
        shot.suite = m_plan.suite->origin();
    shot.cases = m_plan.cases;
    conclude(shot);
    const int concluded = conclude_check(shot, m_plan, *m_pictures, frames.unkept(), m_out, m_err);
    return m_plan.check.has("exit-zero") ? concluded : worse(m_measured, worse(status, concluded));
}

void PlanRun::prepare() {
    const CheckPlan& check = m_plan.check;
    if (check.has("state") && !check.dry_run) {
        m_state.emplace(check.argument("state"), "frame");
        m_sample_state.emplace(check.argument("state"), "exposures");
    }
    m_pictures = std::make_unique<sequence::PictureStore>(picture_folder(check), check.pictures);
    if (m_state)
        remove_abandoned();
}

void PlanRun::remove_abandoned() const {
    const CheckPlan& check = m_plan.check;
    Strings files;
    for (const auto& word : check.words)
        if (!word.second.empty())
            files.push_back(word.second);
    for (size_t i = 0; i < m_plan.runs.size(); ++i) {
        const FrameRun& run = m_plan.runs[i];
        const Strings outputs = words_at(run.words, check.outputs);
        files.insert(files.end(), outputs.begin(), outputs.end());
        if (m_state) {
            files.push_back(m_state->file(m_context.item(i)));
            files.push_back(m_sample_state->file(m_context.item(i)));
        }
        if (const auto images = case_images(check, check.essence)) {
            const Strings named = images->files(unchecked_frame(m_plan, i)).all();
            files.insert(files.end(), named.begin(), named.end());
        }
        const Strings drawn = m_pictures->files(run.frame.item());
        files.insert(files.end(), drawn.begin(), drawn.end());
    }
    remove_abandoned_outputs(files);
}

int PlanRun::loop(std::ostream& err, FrameJob& job, bool goes_on) {
    Loop loop(m_plan, m_out, err, job, goes_on, m_place);
    const int status = loop.run();
    m_threads = std::max(m_threads, loop.threads());
    if (loop.interrupted() != 0) {
        remove_abandoned(); // that a worker has begun while another thread of it was told to end
        throw Interrupted{loop.interrupted(), job.kept()};
    }
    return status;
}

void PlanRun::read_exposures() {
    const std::string& from = m_plan.check.exposures;
    if (!from.empty() && from != "shot")
        m_context.shot = sequence::read_exposures(from);
}

int PlanRun::find_exposures() {
    read_exposures();
    if (m_plan.check.exposures != "shot")
        return 0;
    // What cannot be read is told by the frames' own runs, if there are any.
    const bool alone = m_plan.check.has("statistics");
    std::ostringstream nowhere;
    ExposureFrames frames(m_context, m_sample_state);
    const int status = loop(alone ? m_err : nowhere, frames, true);
    const sequence::ExposureSamples samples = frames.samples();
    if (alone) {
        write_statistics(m_plan.check, sequence::to_json(samples));
        return status;
    }
    if (samples.empty() && !frames.first_error().empty())
        throw CommandError("no exposures of the shot: " + frames.first_error());
    m_context.shot = sequence::shot_exposures(samples);
    return 0;
}

// One pass over the frames for each command that follows the shot. True: the statistics were all
// that was asked for.
bool PlanRun::measure_shots() {
    for (const ShotCommand& command : shots_to_measure(m_plan)) {
        const bool alone = m_plan.check.has("statistics") && m_plan.check.exposures != "shot";
        ShotStatistics shot{command.need.mode, measure_shot(command, alone)};
        if (alone) {
            write_statistics(m_plan.check, shot_text(shot));
            return true;
        }
        // No frame comes to it.
        if (!shot.frames.empty())
            m_context.lights.measured[command.at] = std::move(shot);
    }
    return false;
}

std::vector<FrameLight> PlanRun::measure_shot(const ShotCommand& command, bool alone) {
    std::ostringstream nowhere;
    LightFrames frames(m_context, command.at);
    const int status = loop(alone ? m_err : nowhere, frames, true);
    if (alone)
        m_measured = worse(m_measured, status);
    else
        tell_unmeasured(frames);
    return frames.lights();
}

// A frame that has no part in the exposure of the shot changes that of all others.
void PlanRun::tell_unmeasured(const LightFrames& frames) {
    std::vector<size_t> failed;
    for (size_t i = 0; i < m_plan.runs.size(); ++i)
        if (!frames.error_of(i).empty())
            failed.push_back(i);
    if (failed.empty())
        return;
    const std::string text = unmeasured_text(m_plan, failed, frames.first_error());
    if (!m_plan.skip_bad && !judges_frames())
        throw CommandError(text + " (valid: all frames, --skip-bad-frames for a shot without them, "
                                  "adapt=FILE of --statistics, adapt=frame)");
    tell(text);
}

// A warning of no frame.
void PlanRun::tell(const std::string& warning) {
    m_err << "tonetool WARNING: " << printable(warning) << std::endl;
    m_measured = worse(m_measured, m_plan.warnings_exit ? 2 : 0);
}

} // namespace

int run_plan(const FramePlan& plan, std::ostream& out, std::ostream& err, bool workers) {
    return plan.check.has("merge") ? merge_parts(plan, out, err)
                                   : PlanRun(plan, out, err, workers).run();
}

} // namespace tonetool::runs
