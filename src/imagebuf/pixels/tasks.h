// SPDX-License-Identifier: BSD-3-Clause
// Coarse tasks on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "imagebuf/pixels/oiio_compat.h"

namespace tonetool {

/// Hands the numbers below `count` out to whoever calls, and keeps what the first of the tasks that
/// threw one has thrown: the first by number, whichever thread came there first.
class Tasks {
public:
    Tasks(int64_t count, const std::function<void(int64_t)>& task) : m_count(count), m_task(task) {}

    void work() {
        for (int64_t i = m_next++; i < m_count; i = m_next++) {
            try {
                m_task(i);
            } catch (...) {
                const std::lock_guard<std::mutex> hold(m_lock);
                if (i < m_failed) {
                    m_failed = i;
                    m_failure = std::current_exception();
                }
            }
        }
    }
    void rethrow() const {
        if (m_failure)
            std::rethrow_exception(m_failure);
    }

private:
    int64_t m_count;
    const std::function<void(int64_t)>& m_task;
    std::atomic<int64_t> m_next{0};
    std::exception_ptr m_failure;
    int64_t m_failed = INT64_MAX; ///< its task
    std::mutex m_lock;
};

/// Runs task(i) for every i below count on up to `most` threads, this one among them, that are not
/// those of the pool. An exception of a task is thrown here, once all have ended.
inline void on_own_threads(int64_t count, int most, const std::function<void(int64_t)>& task) {
    Tasks tasks(count, task);
    std::vector<std::thread> threads;
    threads.reserve(size_t(std::max(most, 1)));
    try {
        for (int64_t t = 1; t < std::min<int64_t>(most, count); ++t)
            threads.emplace_back([&tasks] { tasks.work(); });
    } catch (const std::system_error&) {
        // No more threads to be had: those there are do it all.
    }
    tasks.work();
    for (std::thread& thread : threads)
        thread.join();
    tasks.rethrow();
}

/// Runs task(i) for every i below count, each on whichever of `nthreads` threads (0: those of the
/// pool) is free: tasks are coarse. An exception of a task is thrown here, once all have ended.
inline void parallel_tasks(int64_t count, int nthreads, const std::function<void(int64_t)>& task) {
    const int wanted = oiio::threads_of(nthreads);
#if defined(__SANITIZE_THREAD__)
    // The sanitizer cannot see into the library's pool and takes its hand-over of work for races.
    on_own_threads(count, wanted, task);
#else
    Tasks tasks(count, task);
    oiio::on_pool(std::min<int64_t>(wanted, count), [&tasks] { tasks.work(); });
    tasks.rethrow();
#endif
}

} // namespace tonetool
