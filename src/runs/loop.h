// SPDX-License-Identifier: BSD-3-Clause
// Runs over frames, several at a time where asked, what they print in their order.
#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <mutex>
#include <string>

#include "runs/progress.h"
#include "sequence/results/results.h"

namespace tonetool::runs {

/// Statuses by rank: an error dominates a failed threshold, and that a warning.
int worse(int a, int b);

/// What came of one frame's run.
struct Ran {
    int status = 0;
    std::string words;    ///< for a person: "failed (hdrflip: p99 0.2 > 0.1)"
    bool aborted = false; ///< by an error that ends the loop, too
    std::string found{};  ///< for FrameJob::take, as bytes
};

/// What a loop does with each of its frames.
class FrameJob {
public:
    virtual ~FrameJob() = default;
    /// Runs the commands of a frame. That may be in a process of its own, so that nothing comes
    /// back but what is returned and printed.
    virtual Ran run(size_t index, std::ostream& out, std::ostream& err) = 0;
    /// What is said of a frame whose run threw an exception (Status::Error) or ended the process
    /// (Status::Crashed).
    virtual Ran failed(size_t index, sequence::Status status, const std::string& why,
                       std::ostream& err) = 0;
    /// Keeps what `run` or `failed` found: one frame at a time, in the process of the loop.
    virtual void take(size_t index, Ran& ran) = 0;
    /// What is kept of the frames for the next run of the same line; empty: nothing.
    virtual std::string kept() const { return ""; }
};

/// Where the frames of a loop run.
enum class Place {
    ThisProcess,    ///< on threads, where several run at a time
    WorkerProcesses ///< so that a frame that crashes a library ends nothing but its own run
};

class Loop {
public:
    /// `goes_on`: also after a run that was aborted.
    Loop(const FramePlan& plan, std::ostream& out, std::ostream& err, FrameJob& job, bool goes_on,
         Place place)
        : m_plan(plan),
          m_out(out),
          m_err(err),
          m_job(job),
          m_goes_on(goes_on),
          m_place(place),
          m_progress(err, plan) {}

    /// The worst status.
    int run();
    /// What --threads has set in worker processes; 0: nothing. Set here it would start threads,
    /// which processes that are still to be made must not be copied from.
    int threads() const { return m_threads; }
    /// The signal that ended it before all frames were done; 0: none.
    int interrupted() const { return m_interrupted; }

private:
    struct Done {
        std::string out, err;
        Ran ran;
        double seconds = 0;
    };

    bool ends() const { return m_aborted && !m_goes_on; }
    int jobs() const;
    void run_streaming();
    void run_on_threads();
    void run_in_workers();
    Done run_frame(size_t index);
    Done failed(size_t index, sequence::Status status, const std::string& why);
    std::string reply_of(size_t index);
    void work();
    void deliver(size_t index, Done done);
    void print_done();
    bool is_repeated(const std::string& err);
    void tell_repeated();
    void take(size_t index, Ran& ran, std::ostream& err);
    void finished(size_t index, const Ran& ran, double seconds);

    const FramePlan& m_plan;
    std::ostream& m_out;
    std::ostream& m_err;
    FrameJob& m_job;
    bool m_goes_on;
    Place m_place;
    Progress m_progress;
    int m_status = 0, m_threads = 0, m_interrupted = 0;
    bool m_aborted = false;
    std::mutex m_mutex;
    size_t m_next = 0, m_printed = 0;
    std::string m_last_error;      ///< of the frame that was printed last
    int m_repeated = 0;            ///< frames since then with the same one
    std::map<size_t, Done> m_done; ///< frames that wait for earlier ones to be printed
};

} // namespace tonetool::runs
