#include "runs/loop.h"

#include <OpenImageIO/timer.h>
#include <algorithm>
#include <ostream>
#include <sstream>
#include <thread>

namespace tonetool::runs {

int worse(int a, int b) {
    const auto rank = [](int status) { return status == 1 ? 4 : status; };
    return rank(a) > rank(b) ? a : b;
}

int Loop::run() {
    const int jobs = std::min(m_plan.parallel, int(m_plan.runs.size()));
    if (jobs > 1) {
        std::vector<std::thread> threads;
        for (int i = 0; i < jobs; ++i) {
            threads.emplace_back([this] { work(); });
        }
        for (std::thread& thread : threads) {
            thread.join();
        }
        return m_status;
    }
    for (size_t i = 0; i < m_plan.runs.size() && !ends(); ++i) {
        OIIO::Timer time;
        const Ran ran = m_run(i, m_out, m_err);
        finished(i, ran, time());
    }
    return m_status;
}

void Loop::finished(size_t index, const Ran& ran, double seconds) {
    m_status = worse(m_status, ran.status);
    m_aborted |= ran.aborted;
    m_progress.done(m_plan.runs[index], ran.status, ran.words, seconds);
}

void Loop::work() {
    for (;;) {
        size_t index = 0;
        {
            std::lock_guard<std::mutex> lock(m_mutex);
            if (m_next == m_plan.runs.size() || ends()) {
                return;
            }
            index = m_next++;
        }
        OIIO::Timer time;
        std::ostringstream out, err;
        const Ran ran = m_run(index, out, err);
        std::lock_guard<std::mutex> lock(m_mutex);
        m_aborted |= ran.aborted;
        m_done[index] = {out.str(), err.str(), ran, time()};
        for (auto done = m_done.find(m_printed); done != m_done.end();
             done = m_done.find(++m_printed)) {
            m_out << done->second.out << std::flush;
            m_err << done->second.err << std::flush;
            finished(done->first, done->second.ran, done->second.seconds);
            m_done.erase(done);
        }
    }
}

} // namespace tonetool::runs
