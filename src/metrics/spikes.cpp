#include <algorithm>

#include "metrics/fault_scan.h"

namespace tonetool::metrics {
namespace {

constexpr int kReach = Spike::kReach;
using Rows = const float* const (&)[2 * kReach + 1];

// The largest value on the square of the given reach around x.
float largest_on_square(Rows rows, int64_t width, int64_t x, int reach) {
    const int64_t left = std::max<int64_t>(x - reach, 0);
    const int64_t right = std::min<int64_t>(x + reach, width - 1);
    float largest = 0;
    for (int dy = -reach; dy <= reach; ++dy) {
        const float* row = rows[kReach + dy];
        if (!row)
            continue;
        if (dy == -reach || dy == reach) {
            largest = std::max(largest, *std::max_element(row + left, row + right + 1));
            continue;
        }
        if (x - reach >= 0)
            largest = std::max(largest, row[x - reach]);
        if (x + reach < width)
            largest = std::max(largest, row[x + reach]);
    }
    return largest;
}

// Of equal pixels within reach only the first, by row, then column, is the top.
bool is_top(Rows rows, int64_t width, int64_t x) {
    const float value = rows[kReach][x];
    for (int dy = -kReach + 1; dy < kReach; ++dy) {
        const float* row = rows[kReach + dy];
        for (int64_t at = std::max<int64_t>(x - kReach + 1, 0);
             row && at < std::min(x + kReach, width); ++at) {
            const bool before = dy < 0 || (dy == 0 && at < x);
            if (before ? row[at] >= value : row[at] > value)
                return false;
        }
    }
    return true;
}

} // namespace

void find_spikes(const float* const (&rows)[2 * kReach + 1], int64_t width, int64_t x, int64_t y,
                 std::vector<Spike>& out) {
    const float* row = rows[kReach];
    for (int64_t at = 0; at < width; ++at) {
        const float limit = row[at] / Spike::kTimes;
        const bool stands_out = row[at] > 0 && (at < kReach || row[at - kReach] <= limit) &&
                                (at + kReach >= width || row[at + kReach] <= limit);
        if (!stands_out || !is_top(rows, width, at))
            continue;
        const float around = largest_on_square(rows, width, at, kReach);
        if (around <= limit)
            out.push_back({x + at, y, row[at], around});
    }
}

} // namespace tonetool::metrics
