// SPDX-License-Identifier: BSD-3-Clause
#include "runs/loop.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/timer.h>
#include <algorithm>
#include <ostream>
#include <sstream>
#include <thread>

#include "runs/interruption.h"
#include "runs/packed.h"
#include "runs/workers.h"

namespace tonetool::runs {

namespace {

using sequence::Status;

// The exception that is being handled, in words.
std::string what_was_thrown() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        return "not enough memory";
    } catch (const std::exception& problem) {
        return problem.what();
    } catch (...) {
        return "unknown error";
    }
}

// The one error that a frame printed, without the number of the frame; empty for anything else.
std::string error_in(const std::string& err) {
    const std::string begin = "tonetool ERROR";
    if (err.compare(0, begin.size(), begin) != 0 || err.find(begin, 1) != std::string::npos)
        return "";
    const size_t number = std::min(err.find(" (frame "), err.find(" (case ")),
                 line = err.find("\nFull command line was:\n");
    const size_t after =
        line == std::string::npos ? line : err.find('\n', err.find("\n> ", line) + 1);
    const bool more = after != std::string::npos && after + 1 < err.size();
    return number == std::string::npos || line == std::string::npos || number > line || more
               ? ""
               : err.substr(0, number);
}

int library_threads() {
    return OIIO::get_int_attribute("threads");
}

} // namespace

int worse(int a, int b) {
    const auto rank = [](int status) { return status == 1 ? 4 : status; };
    return rank(a) > rank(b) ? a : b;
}

int Loop::jobs() const {
    return std::max(1, std::min(m_plan.parallel, int(m_plan.runs.size())));
}

int Loop::run() {
    const ClearingStream out(m_out, m_progress), err(m_err, m_progress);
    if (m_place == Place::WorkerProcesses)
        run_in_workers();
    else if (jobs() > 1)
        run_on_threads();
    else
        run_streaming();
    tell_repeated();
    return m_status;
}

// What a frame prints is seen as it is printed.
void Loop::run_streaming() {
    for (size_t i = 0; i < m_plan.runs.size() && !ends(); ++i) {
        OIIO::Timer time;
        Ran ran;
        try {
            ran = m_job.run(i, m_out, m_err);
        } catch (...) {
            ran = m_job.failed(i, Status::Error, what_was_thrown(), m_err);
        }
        take(i, ran, m_err);
        finished(i, ran, time());
    }
}

Loop::Done Loop::failed(size_t index, Status status, const std::string& why) {
    std::ostringstream err;
    Done done;
    done.ran = m_job.failed(index, status, why, err);
    done.err = err.str();
    return done;
}

Loop::Done Loop::run_frame(size_t index) {
    OIIO::Timer time;
    Done done;
    try {
        std::ostringstream out, err;
        done.ran = m_job.run(index, out, err);
        done.out = out.str();
        done.err = err.str();
    } catch (...) {
        done = failed(index, Status::Error, what_was_thrown());
    }
    done.seconds = time();
    return done;
}

void Loop::take(size_t index, Ran& ran, std::ostream& err) {
    try {
        m_job.take(index, ran);
    } catch (...) {
        ran = m_job.failed(index, Status::Error, what_was_thrown(), err);
        m_job.take(index, ran);
    }
}

void Loop::deliver(size_t index, Done done) {
    std::ostringstream err;
    take(index, done.ran, err);
    done.err += err.str();
    m_aborted |= done.ran.aborted;
    m_done[index] = std::move(done);
    print_done();
}

void Loop::print_done() {
    for (auto next = m_done.find(m_printed); next != m_done.end();
         next = m_done.find(++m_printed)) {
        m_out << next->second.out << std::flush;
        if (!is_repeated(next->second.err))
            m_err << next->second.err << std::flush;
        finished(next->first, next->second.ran, next->second.seconds);
        m_done.erase(next);
    }
}

// What is wrong with the command line is wrong in every frame: it is told once.
bool Loop::is_repeated(const std::string& err) {
    const std::string what = error_in(err);
    const bool again = !what.empty() && what == m_last_error;
    m_repeated += again ? 1 : 0;
    if (!again) {
        tell_repeated();
        m_last_error = what;
    }
    return again;
}

void Loop::tell_repeated() {
    if (m_repeated > 0) {
        m_err << "tonetool: the same error in " << m_repeated << " more "
              << (m_plan.named ? "case" : "frame") << (m_repeated == 1 ? "" : "s") << std::endl;
    }
    m_repeated = 0;
}

void Loop::finished(size_t index, const Ran& ran, double seconds) {
    m_status = worse(m_status, ran.status);
    m_aborted |= ran.aborted;
    m_progress.done(m_plan.runs[index], ran.status, ran.words, seconds);
}

void Loop::run_on_threads() {
    std::vector<std::thread> threads;
    for (int i = 0; i < jobs(); ++i)
        threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads)
        thread.join();
}

void Loop::work() {
    for (;;) {
        size_t index = 0;
        {
            std::lock_guard<std::mutex> lock(m_mutex);
            if (m_next == m_plan.runs.size() || ends())
                return;
            index = m_next++;
        }
        Done done = run_frame(index);
        std::lock_guard<std::mutex> lock(m_mutex);
        deliver(index, std::move(done));
    }
}

// In a worker process: what the frame came to, and how many threads --threads has asked for.
std::string Loop::reply_of(size_t index) {
    const int before = library_threads();
    const Done done = run_frame(index);
    const int threads = library_threads();
    return packed({done.out, done.err, done.ran.words, done.ran.found,
                   std::to_string(done.ran.status), done.ran.aborted ? "1" : "",
                   std::to_string(done.seconds), threads == before ? "" : std::to_string(threads)});
}

void Loop::run_in_workers() {
    const int processes = jobs();
    // Each has a pool of threads: together as many as one process would have.
    const auto begin = [processes] {
        OIIO::attribute("threads", std::max(1, library_threads() / processes));
    };
    const Interruption interruption;
    const auto next = [this]() -> std::optional<size_t> {
        const bool done =
            m_next == m_plan.runs.size() || ends() || Interruption::signal_number() != 0;
        return done ? std::nullopt : std::optional<size_t>(m_next++);
    };
    const auto done = [&](size_t index, const TaskResult& result) {
        if (interruption.is_for_all(result.signal_number))
            return;
        if (!result.crash.empty()) {
            deliver(index, failed(index, Status::Crashed, result.crash));
            return;
        }
        const Strings texts = unpacked(result.reply, 8);
        Done frame{texts[0],
                   texts[1],
                   {std::stoi(texts[4]), texts[2], !texts[5].empty(), texts[3]},
                   std::stod(texts[6])};
        m_threads = texts[7].empty() ? m_threads : std::stoi(texts[7]);
        deliver(index, std::move(frame));
    };
    m_out.flush();
    Workers(
        processes, [this](size_t index) { return reply_of(index); },
        processes > 1 ? std::function<void()>(begin) : nullptr)
        .run(next, done, interruption.descriptor());
    m_interrupted = Interruption::signal_number();
    if (m_interrupted != 0)
        m_progress.clear();
}

} // namespace tonetool::runs
