// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "metrics/fault_scan.h"

namespace tonetool::metrics {
namespace {

constexpr int kRadius = Spike::kRadius;
using Rows = const float* const (&)[2 * kRadius + 1];

// The largest value on the border of the square of this radius around x.
float largest_on_square(Rows rows, int64_t width, int64_t x, int radius) {
    const int64_t left = std::max<int64_t>(x - radius, 0);
    const int64_t right = std::min<int64_t>(x + radius, width - 1);
    float largest = 0;
    for (int dy = -radius; dy <= radius; ++dy) {
        const float* row = rows[kRadius + dy];
        if (!row)
            continue;
        if (dy == -radius || dy == radius) {
            largest = std::max(largest, *std::max_element(row + left, row + right + 1));
            continue;
        }
        if (x - radius >= 0)
            largest = std::max(largest, row[x - radius]);
        if (x + radius < width)
            largest = std::max(largest, row[x + radius]);
    }
    return largest;
}

// Among equal pixels within the radius only the first, by row, then column, is the firefly.
bool is_top(Rows rows, int64_t width, int64_t x) {
    const float value = rows[kRadius][x];
    for (int dy = -kRadius + 1; dy < kRadius; ++dy) {
        const float* row = rows[kRadius + dy];
        for (int64_t at = std::max<int64_t>(x - kRadius + 1, 0);
             row && at < std::min(x + kRadius, width); ++at) {
            const bool before = dy < 0 || (dy == 0 && at < x);
            if (before ? row[at] >= value : row[at] > value)
                return false;
        }
    }
    return true;
}

} // namespace

void find_spikes(const float* const (&rows)[2 * kRadius + 1], int64_t width, int64_t x, int64_t y,
                 std::vector<Spike>& out) {
    const float* row = rows[kRadius];
    for (int64_t at = 0; at < width; ++at) {
        const float value = row[at], limit = value / Spike::kTimes;
        const bool left = at < kRadius || row[at - kRadius] <= limit;
        const bool right = at >= width - kRadius || row[at + kRadius] <= limit;
        if (!(value > 0 && left && right) || !is_top(rows, width, at))
            continue;
        const float around = largest_on_square(rows, width, at, kRadius);
        if (around <= limit)
            out.push_back({x + at, y, value, around});
    }
}

} // namespace tonetool::metrics
