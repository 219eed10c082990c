// SPDX-License-Identifier: BSD-3-Clause
// Blocks of rows that are visited in parallel; results do not depend on how they are scheduled.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "kernels/views.h"

namespace tonetool::metrics {

/// Rows of a block, which has about 2^16 pixels.
inline int64_t block_rows(int width) {
    constexpr int64_t pixels = int64_t(1) << 16;
    return std::max<int64_t>(1, pixels / std::max(width, 1));
}

/// Calls visit(first row, end row) for blocks, in any order.
template <class Visit>
void for_each_block(int width, int height, const kernels::ParallelFor& parallel,
                    const Visit& visit) {
    if (width <= 0 || height <= 0)
        return;
    const int64_t rows = block_rows(width);
    parallel((height + rows - 1) / rows, [&](int64_t block) {
        visit(int(block * rows), int(std::min<int64_t>(height, (block + 1) * rows)));
    });
}

/// Accumulators of type T, as many as are in use at once: large tables are not made for every
/// block. Their final content must not depend on the order of additions, as that of integers does
/// not.
template <class T>
class Accumulators {
public:
    explicit Accumulators(std::function<T()> make) : m_make(std::move(make)) {}

    /// Calls add(accumulator) with one that nobody else uses meanwhile.
    template <class Add>
    void with_one(const Add& add) {
        T* const one = take();
        add(*one);
        const std::lock_guard<std::mutex> hold(m_lock);
        m_idle.push_back(one);
    }
    std::vector<std::unique_ptr<T>>& all() { return m_all; }

private:
    T* take() {
        {
            const std::lock_guard<std::mutex> hold(m_lock);
            if (!m_idle.empty()) {
                T* const one = m_idle.back();
                m_idle.pop_back();
                return one;
            }
        }
        auto made = std::make_unique<T>(m_make());
        const std::lock_guard<std::mutex> hold(m_lock);
        m_all.push_back(std::move(made));
        return m_all.back().get();
    }

    const std::function<T()> m_make;
    std::mutex m_lock;
    std::vector<std::unique_ptr<T>> m_all;
    std::vector<T*> m_idle;
};

} // namespace tonetool::metrics
