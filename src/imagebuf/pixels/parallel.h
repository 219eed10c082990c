// SPDX-License-Identifier: BSD-3-Clause
// OpenImageIO's thread pool as kernels and algorithms see it.
#pragma once

#include <functional>
#include <vector>

#include "imagebuf/pixels/tasks.h"
#include "kernels/views.h"

namespace tonetool {

/// 0 threads: OpenImageIO's "threads" attribute. Inside a pool thread everything runs serially.
inline kernels::ParallelFor make_parallel(int nthreads) {
    return [nthreads](int64_t count, const std::function<void(int64_t)>& task) {
        parallel_tasks(count, nthreads, task);
    };
}

/// Runs the tasks at the same time on threads of their own, from which the pool can be used; one
/// after the other where only one thread is wanted.
inline void run_beside(const std::vector<std::function<void()>>& tasks, int nthreads) {
    on_own_threads(int64_t(tasks.size()), nthreads == 1 ? 1 : 4,
                   [&](int64_t i) { tasks[size_t(i)](); });
}

} // namespace tonetool
