// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/rectangle_scan.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

namespace tonetool::metrics {
namespace {

bool same_value(float a, float b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

bool same_pixel(const float* a, const float* b) {
    return same_value(a[0], b[0]) && same_value(a[1], b[1]) && same_value(a[2], b[2]);
}

uint32_t bits_of(float value) {
    constexpr uint32_t nan = 0x7fc00000;
    uint32_t bits = 0;
    if (std::isnan(value))
        return nan;
    if (value != 0)
        std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

} // namespace

std::vector<FlatRun> scan_runs(const float* rgb, int64_t width, int64_t x) {
    std::vector<FlatRun> runs;
    for (int64_t first = 0; first < width;) {
        const float* color = rgb + 3 * first;
        int64_t end = first + 1;
        while (end < width && same_pixel(color, rgb + 3 * end))
            ++end;
        if (end - first >= FlatRun::kShortest) {
            runs.push_back({x + first,
                            end - first,
                            {bits_of(color[0]), bits_of(color[1]), bits_of(color[2])},
                            0});
        }
        first = end;
    }
    return runs;
}

// Both lists go from left to right, so one walk over them finds the runs that go on.
void RectangleScan::add_row(int64_t y, const std::vector<FlatRun>& runs) {
    std::vector<FlatRectangle> open;
    auto above = m_open.begin();
    for (const FlatRun& run : runs) {
        while (above != m_open.end() && above->run.x < run.x)
            close(*above++);
        if (above != m_open.end() && above->run.is_above(run)) {
            above->run.background += run.background;
            ++above->height;
            open.push_back(*above++);
        } else {
            open.push_back({run, y, 1});
        }
    }
    while (above != m_open.end())
        close(*above++);
    m_open = std::move(open);
}

void RectangleScan::close(const FlatRectangle& rectangle) {
    if (rectangle.height < FlatRectangle::kLowest)
        return;
    m_closed.push_back(rectangle);
    if (m_closed.size() > 4 * m_most)
        keep_largest(m_most + 1); // one of them may be too large
}

void RectangleScan::keep_largest(size_t most) {
    const auto key = [](const FlatRectangle& r) {
        return std::make_tuple(-r.pixels(), r.y, r.run.x);
    };
    std::sort(m_closed.begin(), m_closed.end(),
              [&](const FlatRectangle& a, const FlatRectangle& b) { return key(a) < key(b); });
    m_closed.resize(std::min(m_closed.size(), most));
}

std::vector<FlatRectangle> RectangleScan::finish(int64_t pixels) {
    add_row(0, {});
    const auto is_too_large = [&](const FlatRectangle& r) { return r.pixels() >= pixels; };
    m_closed.erase(std::remove_if(m_closed.begin(), m_closed.end(), is_too_large), m_closed.end());
    keep_largest(m_most);
    std::sort(m_closed.begin(), m_closed.end(), [](const FlatRectangle& a, const FlatRectangle& b) {
        return std::tie(a.y, a.run.x) < std::tie(b.y, b.run.x);
    });
    return std::move(m_closed);
}

void BorderScan::add(int64_t at, int64_t length, bool is_same) {
    const auto part = size_t(at * kParts / length);
    same[part] += is_same;
    ++all[part];
}

std::array<int, BorderScan::kParts> BorderScan::shares() const {
    std::array<int, kParts> shares{};
    for (size_t i = 0; i < shares.size(); ++i)
        shares[i] = all[i] > 0 ? int((100 * same[i] + all[i] / 2) / all[i]) : 0;
    return shares;
}

} // namespace tonetool::metrics
