// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/value_scan.h"

#include <algorithm>
#include <iterator>

#include "metrics/rectangle_scan.h"

namespace tonetool::metrics {
namespace {

bool is_lit(const float* color) {
    constexpr float dark = 1e-6f;
    return color[0] > dark || color[1] > dark || color[2] > dark;
}

// A value that is rounded to the half float before or after 1.
bool is_beside_one(float value) {
    constexpr float before = 0x1p-11f, after = 0x1p-10f;
    return (value > 1 - 1.5f * before && value < 1 - 0.5f * before) ||
           (value > 1 + 0.5f * after && value < 1 + 1.5f * after);
}

void scan_clamps(const float* color, ValueScan& out) {
    constexpr float largest_half = 65504;
    int ones = 0, beside = 0, largest = 0, lit = 0;
    for (int c = 0; c < 3; ++c) {
        ones += color[c] == 1;
        beside += is_beside_one(color[c]);
        largest += color[c] == largest_half;
        lit += color[c] > 0;
    }
    out.at_one += lit == 3 && ones > 0 && ones < 3;
    out.beside_one += beside > 0;
    out.at_largest_half += largest > 0;
}

void keep_different(std::vector<float>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    values.resize(std::min(values.size(), ValueScan::kMost));
}

} // namespace

// Once there are kMost values, it does not matter which.
void ValueScan::add(const ValueScan& later) {
    pixels += later.pixels;
    lit += later.lit;
    greens += later.greens;
    at_one += later.at_one;
    beside_one += later.beside_one;
    at_largest_half += later.at_largest_half;
    for (size_t i = 0; i < 2; ++i) {
        pairs[i] += later.pairs[i];
        same[i] += later.same[i];
    }
    if (values.size() == kMost || later.values.empty())
        return;
    std::vector<float> all;
    std::set_union(values.begin(), values.end(), later.values.begin(), later.values.end(),
                   std::back_inserter(all));
    all.resize(std::min(all.size(), kMost));
    values = std::move(all);
}

std::array<double, 2> ValueScan::shares() const {
    std::array<double, 2> shares{};
    const double lit_share = pixels > 0 ? double(lit) / double(pixels) : 0;
    for (size_t i = 0; i < 2; ++i)
        if (pairs[i] > 0 && lit_share > 0)
            shares[i] = double(same[i]) / double(pairs[i]) / lit_share;
    return shares;
}

ValueScan scan_values(const float* rgb, int64_t width, bool values) {
    ValueScan out;
    out.pixels = width;
    for (int64_t x = 0; x < width; ++x) {
        const float* color = rgb + 3 * x;
        out.lit += is_lit(color);
        scan_clamps(color, out);
        if (color[1] > 0.01f && color[1] < 1) {
            ++out.greens;
            if (values)
                out.values.push_back(color[1]);
        }
        if (x + 1 < width) {
            const auto parity = size_t(x % 2);
            ++out.pairs[parity];
            out.same[parity] += same_color(color, color + 3) && is_lit(color);
        }
    }
    keep_different(out.values);
    return out;
}

} // namespace tonetool::metrics
