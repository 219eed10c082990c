// SPDX-License-Identifier: BSD-3-Clause
// Ways to run tasks, under which results must not differ.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "kernels/views.h"

namespace tonetool::kernels {

inline ParallelFor in_order() {
    return [](int64_t n, const std::function<void(int64_t)>& task) {
        for (int64_t i = 0; i < n; ++i)
            task(i);
    };
}

inline ParallelFor backwards() {
    return [](int64_t n, const std::function<void(int64_t)>& task) {
        for (int64_t i = n; i-- > 0;)
            task(i);
    };
}

inline ParallelFor on_threads(int threads) {
    return [threads](int64_t n, const std::function<void(int64_t)>& task) {
        std::atomic<int64_t> next{0};
        std::vector<std::thread> pool;
        for (int t = 0; t < threads; ++t)
            pool.emplace_back([&] {
                for (int64_t i = next++; i < n; i = next++)
                    task(i);
            });
        for (auto& thread : pool)
            thread.join();
    };
}

} // namespace tonetool::kernels
