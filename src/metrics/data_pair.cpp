// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/data_pair.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tonetool::metrics {
namespace {

// The pixels of one column in both layers.
struct PixelPair {
    const float *a, *b;
    size_t channels;
};

uint32_t bits_of(float value) {
    uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

bool same_bits(const PixelPair& pixel) {
    return std::memcmp(pixel.a, pixel.b, pixel.channels * sizeof(float)) == 0;
}

bool is_sky(float depth) {
    return !(depth < DataPair::kSky); // NaN is
}

double largest(const float* pixel, size_t channels) {
    double most = 0;
    for (size_t c = 0; c < channels; ++c)
        most = std::max(most, std::abs(double(pixel[c])));
    return most;
}

// Infinities and NaN are equal where both have them, and as far as can be from numbers.
double value_difference(float a, float b) {
    if (bits_of(a) == bits_of(b) || (std::isnan(a) && std::isnan(b)))
        return 0;
    const double difference = std::abs(double(a) - double(b));
    return std::isfinite(difference) ? difference : HUGE_VAL;
}

double largest_difference(const PixelPair& pixel) {
    double most = 0;
    for (size_t c = 0; c < pixel.channels; ++c)
        most = std::max(most, value_difference(pixel.a[c], pixel.b[c]));
    return most;
}

// The relative difference of depths, or of positions at a depth.
double distance_of(const PixelPair& pixel, double size) {
    constexpr double least = 1e-6;
    return largest_difference(pixel) / std::max(std::abs(size), least);
}

double depth_difference(const PixelPair& pixel) {
    const bool sky = is_sky(*pixel.a);
    if (sky != is_sky(*pixel.b))
        return 1;
    return sky ? 0 : distance_of(pixel, *pixel.a);
}

// Where nothing is, positions mean nothing; the depth says where that is.
double position_difference(const PixelPair& pixel, const float* depth) {
    if (depth)
        return is_sky(*depth) ? 0 : distance_of(pixel, *depth);
    const double size = largest(pixel.a, pixel.channels);
    const bool sky = !(size < double(DataPair::kSky));
    if (sky != !(largest(pixel.b, pixel.channels) < double(DataPair::kSky)))
        return 1;
    return sky ? 0 : distance_of(pixel, size);
}

bool is_finite(const float* pixel, size_t channels) {
    return std::all_of(pixel, pixel + channels, [](float value) { return std::isfinite(value); });
}

// What is not finite has no direction.
bool is_normal(const float* v) {
    const double square = double(v[0]) * v[0] + double(v[1]) * v[1] + double(v[2]) * v[2];
    return square > 0.25 && std::isfinite(square);
}

double motion_difference(const PixelPair& pixel) {
    double most = 0;
    for (size_t c = 0; c < pixel.channels; c += 2) {
        const double x = value_difference(pixel.a[c], pixel.b[c]);
        const bool has_y = c + 1 < pixel.channels;
        const double y = has_y ? value_difference(pixel.a[c + 1], pixel.b[c + 1]) : 0;
        most = std::max(most, std::sqrt(x * x + y * y));
    }
    return most;
}

// The coverage of an id in a pixel.
double coverage_of(const float* pixel, size_t channels, uint32_t id) {
    double sum = 0;
    for (size_t c = 0; c + 1 < channels; c += 2)
        if (bits_of(pixel[c]) == id)
            sum += double(pixel[c + 1]);
    return sum;
}

// Of all ids; a lone id covers its pixel.
double coverage_of(const float* pixel, size_t channels) {
    if (channels % 2 != 0)
        return bits_of(*pixel) != 0;
    double sum = 0;
    for (size_t c = 1; c < channels; c += 2)
        sum += std::isfinite(pixel[c]) ? double(pixel[c]) : 0;
    return sum;
}

// Half of the differences of the coverages of all ids: 1 where it is another object altogether.
double id_difference(const PixelPair& pixel) {
    if (same_bits(pixel))
        return 0;
    if (pixel.channels % 2 != 0)
        return 1;
    double sum = 0;
    for (const float* side : {pixel.a, pixel.b}) {
        for (size_t c = 0; c < pixel.channels; c += 2) {
            const uint32_t id = bits_of(side[c]);
            const bool seen_here = c > 0 && coverage_of(side, c, id) != 0;
            const bool seen_in_a = side == pixel.b && coverage_of(pixel.a, pixel.channels, id) != 0;
            if (!seen_here && !seen_in_a)
                sum += std::abs(coverage_of(pixel.a, pixel.channels, id) -
                                coverage_of(pixel.b, pixel.channels, id));
        }
    }
    return std::isfinite(sum) ? sum / 2 : 1;
}

// The difference of a pixel by its kind; adds to the row what else it counts.
double difference_of(PairKind kind, const PixelPair& pixel, const float* depth, DataPair& row) {
    switch (kind) {
    case PairKind::Depth:
        return depth_difference(pixel);
    case PairKind::Position:
        return position_difference(pixel, depth);
    case PairKind::Normal: {
        const bool a = is_normal(pixel.a), b = is_normal(pixel.b);
        row.both += a && b;
        row.one += a != b;
        row.lost += a && !is_finite(pixel.b, 3);
        const double angle = a && b ? angle_between(pixel.a, pixel.b) : 0;
        if (a && b)
            row.codes.push_back(StepHistogram::code(float(angle)));
        return angle;
    }
    case PairKind::Motion: {
        const double distance = std::min(motion_difference(pixel), double(DataPair::kSky));
        row.lost += is_finite(pixel.a, pixel.channels) && !is_finite(pixel.b, pixel.channels);
        row.codes.push_back(StepHistogram::code(float(distance)));
        return distance;
    }
    case PairKind::Ids:
        row.covered[0] += coverage_of(pixel.a, pixel.channels);
        row.covered[1] += coverage_of(pixel.b, pixel.channels);
        return id_difference(pixel);
    case PairKind::Alpha:
        return largest_difference(pixel);
    case PairKind::Data:
        break;
    }
    return same_bits(pixel) ? 0 : 1;
}

// From which difference on a pixel counts as off.
double limit_of(PairKind kind) {
    switch (kind) {
    case PairKind::Depth:
    case PairKind::Position:
        return 1e-3;
    case PairKind::Normal:
        return 10;
    case PairKind::Motion:
        return 0.5;
    case PairKind::Ids:
        return 0.1;
    case PairKind::Alpha:
        return 0.02;
    case PairKind::Data:
        break;
    }
    return 0;
}

} // namespace

double angle_between(const float* a, const float* b) {
    constexpr double degrees = 57.29577951308232;
    const double x = double(a[1]) * b[2] - double(a[2]) * b[1];
    const double y = double(a[2]) * b[0] - double(a[0]) * b[2];
    const double z = double(a[0]) * b[1] - double(a[1]) * b[0];
    const double dot = double(a[0]) * b[0] + double(a[1]) * b[1] + double(a[2]) * b[2];
    return degrees * std::atan2(std::sqrt(x * x + y * y + z * z), dot);
}

void DataPair::add(const DataPair& row) {
    pixels += row.pixels;
    off += row.off;
    both += row.both;
    one += row.one;
    sum += row.sum;
    lost += row.lost;
    covered[0] += row.covered[0];
    covered[1] += row.covered[1];
    steps.add(row.codes);
    if (row.most > most) {
        most = row.most;
        x = row.x;
        y = row.y;
    }
}

DataPair scan_pair(PairKind kind, const std::vector<float>& a, const std::vector<float>& b,
                   size_t channels, const float* depth, int64_t y) {
    DataPair row;
    row.y = y;
    row.pixels = int64_t(a.size() / channels);
    const double limit = limit_of(kind);
    for (int64_t x = 0; x < row.pixels; ++x) {
        const size_t at = size_t(x) * channels;
        const int64_t ones = row.one;
        const double difference =
            difference_of(kind, {&a[at], &b[at], channels}, depth ? depth + x : nullptr, row);
        row.off += difference > limit;
        row.sum += std::min(difference, 1.0);                  // of what is not finite
        const double size = row.one > ones ? 180 : difference; // a normal in only one
        if (size > row.most) {
            row.most = size;
            row.x = x;
        }
    }
    return row;
}

} // namespace tonetool::metrics
