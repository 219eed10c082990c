// All that differs between OpenImageIO 2.4, 2.5 and 3.x for this project.
//
// 2.4 and 2.5: paropt and parallel_for_chunked as used here exist; 3.x keeps both spellings.
// TypeDesc constants are named TypeFloat, TypeInt, TypeString in all three.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/oiioversion.h>
#include <OpenImageIO/parallel.h>
#include <exception>
#include <functional>
#include <mutex>
#if defined(__SANITIZE_THREAD__)
#include <atomic>
#include <thread>
#include <vector>
#endif

#if OIIO_VERSION < 20400
#error "tonetool needs OpenImageIO 2.4 or newer"
#endif

namespace tonetool::oiio {

/// Runs task(i) for every i below count, one at a time per thread: tasks are coarse. An exception
/// of a task is thrown here, once all have ended.
inline void parallel_tasks(int64_t count, int nthreads, const std::function<void(int64_t)>& task) {
    std::exception_ptr failure;
    std::mutex lock;
    const auto guarded = [&](int64_t i) {
        try {
            task(i);
        } catch (...) {
            const std::lock_guard<std::mutex> hold(lock);
            failure = std::current_exception();
        }
    };
#if defined(__SANITIZE_THREAD__)
    // The sanitizer cannot see into the library's pool and takes its hand-over of work for races.
    std::atomic<int64_t> next{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < (nthreads > 0 ? nthreads : 4); ++t)
        threads.emplace_back([&] {
            for (int64_t i = next++; i < count; i = next++)
                guarded(i);
        });
    for (std::thread& thread : threads)
        thread.join();
#else
    OIIO::parallel_for_chunked(
        0, count, 1,
        [&guarded](int64_t begin, int64_t end) {
            for (int64_t i = begin; i < end; ++i)
                guarded(i);
        },
        OIIO::paropt(nthreads));
#endif
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace tonetool::oiio
