// Runs over frames, several at a time where asked, what they print in their order.
#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <mutex>
#include <string>

#include "runs/frames.h"

namespace tonetool::runs {

/// Statuses by rank: an error dominates a failed threshold, and that a warning.
int worse(int a, int b);

/// What came of one run.
struct Ran {
    int status = 0;
    std::string words;    ///< for a person: "failed (hdrflip: p99 0.2 > 0.1)"
    bool aborted = false; ///< by an error that ends the loop, too
};

class Loop {
public:
    using Run = std::function<Ran(size_t index, std::ostream& out, std::ostream& err)>;
    /// `goes_on`: also after a run that was aborted.
    Loop(const FramePlan& plan, std::ostream& out, std::ostream& err, Run run, bool goes_on)
        : m_plan(plan),
          m_out(out),
          m_err(err),
          m_run(std::move(run)),
          m_goes_on(goes_on),
          m_progress(err, plan) {}

    /// The worst status.
    int run();

private:
    bool ends() const { return m_aborted && !m_goes_on; }
    void work();
    void finished(size_t index, const Ran& ran, double seconds);

    const FramePlan& m_plan;
    std::ostream& m_out;
    std::ostream& m_err;
    Run m_run;
    bool m_goes_on;
    Progress m_progress;
    int m_status = 0;
    bool m_aborted = false;
    std::mutex m_mutex;
    size_t m_next = 0, m_printed = 0;
    struct Done {
        std::string out, err;
        Ran ran;
        double seconds;
    };
    std::map<size_t, Done> m_done; ///< frames that wait for earlier ones to be printed
};

} // namespace tonetool::runs
