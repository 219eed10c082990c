// All that differs between OpenImageIO 2.4, 2.5 and 3.x for this project.
//
// 2.4 and 2.5: paropt and parallel_for_chunked as used here exist; 3.x keeps both spellings.
// TypeDesc constants are named TypeFloat, TypeInt, TypeString in all three.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/oiioversion.h>
#include <OpenImageIO/parallel.h>
#include <OpenImageIO/sysutil.h>
#include <OpenImageIO/thread.h>
#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#if OIIO_VERSION < 20400
#error "tonetool needs OpenImageIO 2.4 or newer"
#endif

namespace tonetool::oiio {

/// Whether an image only knows its file so far: its header is read, its pixels are not.
inline bool is_unread_file(const OIIO::ImageBuf& image) {
    return image.storage() == OIIO::ImageBuf::IMAGECACHE;
}

/// Threads that OpenEXR decodes with.
inline int exr_threads() {
    int threads = 0;
    OIIO::getattribute("exr_threads", threads);
    return threads > 0 ? threads : int(OIIO::Sysutil::hardware_concurrency());
}

/// Hands the numbers below `count` out to whoever calls, and keeps what a task threw.
class Tasks {
public:
    Tasks(int64_t count, const std::function<void(int64_t)>& task) : m_count(count), m_task(task) {}

    void work() {
        for (int64_t i = m_next++; i < m_count; i = m_next++) {
            try {
                m_task(i);
            } catch (...) {
                const std::lock_guard<std::mutex> hold(m_lock);
                m_failure = std::current_exception();
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

/// Threads that 0 or a number of them stands for.
inline int threads_of(int nthreads) {
    return nthreads > 0 ? nthreads : OIIO::default_thread_pool()->size() + 1;
}

/// Runs task(i) for every i below count, each on whichever of `nthreads` threads (0: those of the
/// pool) is free: tasks are coarse. An exception of a task is thrown here, once all have ended.
inline void parallel_tasks(int64_t count, int nthreads, const std::function<void(int64_t)>& task) {
    const int wanted = threads_of(nthreads);
#if defined(__SANITIZE_THREAD__)
    // The sanitizer cannot see into the library's pool and takes its hand-over of work for races.
    on_own_threads(count, wanted, task);
#else
    const int64_t workers = std::min<int64_t>(wanted, count);
    Tasks tasks(count, task);
    // As many tasks as threads: 2.4 does not look at the number of threads for chunks of one.
    OIIO::parallel_for_chunked(
        0, workers, 1, [&tasks](int64_t, int64_t) { tasks.work(); },
        OIIO::paropt(int(std::max<int64_t>(workers, 1))));
    tasks.rethrow();
#endif
}

} // namespace tonetool::oiio
