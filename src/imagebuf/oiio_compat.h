// All that differs between OpenImageIO 2.4, 2.5 and 3.x for this project.
//
// 2.4 and 2.5: paropt and parallel_for_chunked as used here exist; 3.x keeps both spellings.
// TypeDesc constants are named TypeFloat, TypeInt, TypeString in all three.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/oiioversion.h>
#include <OpenImageIO/parallel.h>
#include <OpenImageIO/thread.h>
#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#if defined(__SANITIZE_THREAD__)
#include <thread>
#include <vector>
#endif

#if OIIO_VERSION < 20400
#error "tonetool needs OpenImageIO 2.4 or newer"
#endif

namespace tonetool::oiio {

/// Runs task(i) for every i below count, each on whichever of `nthreads` threads (0: those of the
/// pool) is free: tasks are coarse. An exception of a task is thrown here, once all have ended.
inline void parallel_tasks(int64_t count, int nthreads, const std::function<void(int64_t)>& task) {
    std::atomic<int64_t> next{0};
    std::exception_ptr failure;
    std::mutex lock;
    const auto work = [&] {
        for (int64_t i = next++; i < count; i = next++) {
            try {
                task(i);
            } catch (...) {
                const std::lock_guard<std::mutex> hold(lock);
                failure = std::current_exception();
            }
        }
    };
    const int wanted = nthreads > 0 ? nthreads : OIIO::default_thread_pool()->size() + 1;
    const int64_t workers = std::min<int64_t>(wanted, count);
#if defined(__SANITIZE_THREAD__)
    // The sanitizer cannot see into the library's pool and takes its hand-over of work for races.
    std::vector<std::thread> threads;
    for (int64_t t = 0; t < workers; ++t)
        threads.emplace_back(work);
    for (std::thread& thread : threads)
        thread.join();
#else
    // As many tasks as threads: 2.4 does not look at the number of threads for chunks of one.
    OIIO::parallel_for_chunked(
        0, workers, 1, [&work](int64_t, int64_t) { work(); },
        OIIO::paropt(int(std::max<int64_t>(workers, 1))));
#endif
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace tonetool::oiio
