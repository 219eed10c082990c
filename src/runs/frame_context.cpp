// SPDX-License-Identifier: BSD-3-Clause
#include "runs/frame_context.h"

#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <sstream>

#include "chain/manual/help.h"
#include "chain/session/runner.h"
#include "runs/check_end.h"
#include "sequence/frames/file_sequence.h"
#include "sequence/results/probe.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

using chain::Runner;
using chain::Session;
using sequence::FrameResult;
using sequence::State;
using sequence::Status;

// Of what one comparison alone would take, half of the computer's memory; --memory says otherwise.
uint64_t share_of_memory(int parallel) {
    constexpr uint64_t enough = uint64_t(1) << 29;
    return parallel < 2
               ? 0
               : std::max(enough, OIIO::Sysutil::physical_memory() / 2 / uint64_t(parallel));
}

// Of cases: the folders of their names are made as they are written.
void make_folders(const FramePlan& plan, const FrameRun& run) {
    for (const size_t at : plan.check.outputs) {
        const std::filesystem::path folder = std::filesystem::path(run.words[at]).parent_path();
        const std::string& pattern = plan.line.texts[at];
        if (!sequence::has_names(pattern) || plan.check.dry_run || folder.empty())
            continue;
        const std::string fixed =
            sequence::NamePattern(sequence::without_range(pattern), true).fixed_part();
        const std::string root = fixed.substr(0, fixed.rfind('/') + 1);
        std::error_code why; // a write tells what is wrong
        if (root.empty() || std::filesystem::is_directory(root, why))
            std::filesystem::create_directories(folder, why);
    }
}

// Of a case: the reference would pass as its own test.
bool same_file(const FramePlan& plan, const CheckPlan& check, const Strings& words) {
    const Strings files = words_at(words, check.inputs.size() == 2 ? check.inputs : plan.sequences);
    std::error_code none;
    return plan.named && check.compares_pairs() && files.size() > 1 &&
           std::filesystem::equivalent(files[0], files[1], none);
}

sequence::SuiteCase said_by_suite(const FrameRun& run) {
    sequence::SuiteCase said;
    said.line = run.of_suite.line;
    said.why = run.of_suite.why;
    if (run.of_suite.own)
        said.check = run.of_suite.own->check.essence;
    return said;
}

} // namespace

std::string crashed(const std::string& how) {
    return "the libraries that read or compare its files crashed: " + how;
}

std::string keep_in(const State& state, const sequence::Item& item, const sequence::Origin& origin,
                    const sequence::FileLog& files, const sequence::Kept& found) {
    try {
        state.keep(item, origin, files, found);
        return "";
    } catch (const std::exception& problem) {
        return problem.what();
    }
}

std::string kept_in(const std::optional<State>& state, const FramePlan& plan,
                    const std::function<bool(size_t)>& is_kept) {
    if (!state)
        return "";
    size_t count = 0;
    const size_t all = plan.runs.size();
    for (size_t i = 0; i < all; ++i)
        count += is_kept(i) ? 1 : 0;
    return std::to_string(count) + " of " + std::to_string(all) +
           (plan.named ? " case" : " frame") + (all == 1 ? "" : "s") + " kept in " +
           plan.check.argument("state");
}

FrameResult unchecked_frame(const FramePlan& plan, size_t index) {
    const FrameRun& run = plan.runs[index];
    const auto& inputs = plan.check_of(run).inputs;
    const bool of_inputs = plan.sequences.empty() || (plan.named && inputs.size() == 2);
    const Strings names = words_at(run.words, of_inputs ? inputs : plan.sequences);
    FrameResult result;
    result.of_suite = said_by_suite(run);
    result.frame = run.frame.number;
    result.view = run.frame.view;
    result.name = run.frame.name;
    result.method = run.frame.method;
    result.test_frame = run.test_frame;
    result.reference = names.size() > 1 ? names[0] : "";
    result.test = names.empty() ? "" : names[names.size() > 1 ? 1 : 0];
    return result;
}

sequence::Item FrameContext::item(size_t index) const {
    return plan.runs[index].frame.item();
}

Session FrameContext::session(size_t index, std::ostream& out, std::ostream& err) const {
    const FrameRun& run = plan.runs[index];
    Session session(out, err,
                    plan.suite ? plan.suite->case_line(run.frame.item())
                               : full_command_line(plan.line, run.words, plan.line.compat));
    set_for_line(session, plan);
    session.frame = run.frame;
    session.in_all_frames = [this](size_t at) {
        Strings names;
        for (const FrameRun& other : plan.runs)
            if (at < other.words.size())
                names.push_back(other.words[at]);
        return names;
    };
    session.check.shot = shot ? &*shot : nullptr;
    session.shot = lights;
    if (plan.loops && !plan.named)
        session.shot.find = [this, index](size_t at, int number) {
            return frames->find(*this, index, at, number);
        };
    session.written = written;
    session.settings.parallel = plan.parallel;
    session.settings.memory = share_of_memory(plan.parallel);
    return session;
}

void FrameContext::run_commands(Session& session, size_t index, const Strings& words) const {
    const FrameRun& run = plan.runs[index];
    const Strings files = words_at(words, plan.sequences);
    const sequence::Probe gone = sequence::missing_of(files);
    if (plan.named && gone.status != Status::Missing)
        make_folders(plan, run);
    if (gone.status == Status::Missing)
        session.check.absent = absent_approved(session, files);
    session.check.why_absent = run.absent;
    session.check.between = !session.check.absent.empty() && is_between_approved(index);
    if (same_file(plan, plan.check_of(run), words)) {
        session.error("", "reference and test are the same file");
    } else if (gone.status != Status::Missing || !session.check.absent.empty()) {
        Runner(session, words).run_all();
        if (session.outcome.misused)
            session.out << chain::help_text();
    } else {
        session.error("", run.absent.empty() ? gone.message : run.absent);
    }
}

// The first of the files, if it alone is missing and the line compares with the approved version.
std::string FrameContext::absent_approved(const Session& session, const Strings& files) const {
    const bool may_be = session.check.result && plan.check.has("against") && files.size() > 1;
    const Strings others(files.begin() + (files.empty() ? 0 : 1), files.end());
    return may_be && sequence::missing_of(others).status != Status::Missing ? files.front() : "";
}

bool FrameContext::is_between_approved(size_t index) const {
    const FrameRun& run = plan.runs[index];
    const std::string& pattern = plan.line_of(run).texts[plan.sequences.front()];
    if (plan.named || !sequence::is_pattern(pattern))
        return false;
    bool earlier = false, later = false;
    for (const sequence::Item& there : sequence::list_all_files(pattern, plan.options).items) {
        if (there.view != run.frame.view)
            continue;
        earlier = earlier || there.frame < run.frame.number;
        later = later || there.frame > run.frame.number;
    }
    return earlier && later;
}

void FrameContext::print_error(size_t index, const std::string& error, std::ostream& err) const {
    std::ostringstream nowhere;
    session(index, nowhere, err).error("", error);
}

Ran PlainFrames::run(size_t index, std::ostream& out, std::ostream& err) {
    Session session = m_context.session(index, out, err);
    m_context.run_commands(session, index, m_context.plan.runs[index].words);
    static const char* const words[] = {"done", "error", "warnings", "a threshold was exceeded"};
    const int status = session.exit_status();
    return {status, words[status], session.outcome.aborted};
}

Ran PlainFrames::failed(size_t index, Status status, const std::string& why, std::ostream& err) {
    m_context.print_error(index, status == Status::Crashed ? crashed(why) : why, err);
    return {1, "error", true};
}

} // namespace tonetool::runs
