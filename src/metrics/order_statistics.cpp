#include "metrics/order_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace tonetool::metrics {
namespace {

constexpr uint32_t kInfinity = 0x7f800000u;
constexpr size_t kBuckets = kInfinity >> 16;
constexpr size_t kLow = size_t(1) << 16;

uint32_t bits_of(float value) {
    uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

float float_of(uint32_t bits) {
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

} // namespace

template <class F>
void OrderStatistics::for_each(const F& visit) const {
    for (int y = 0; y < m_height; ++y)
        for (int x = 0; x < m_width; ++x) {
            const float value = m_data[y * m_stride + x];
            const uint32_t bits = bits_of(value) == 0x80000000u ? 0 : bits_of(value);
            if (bits < kInfinity)
                visit(bits, value);
        }
}

OrderStatistics::OrderStatistics(const float* data, int width, int height, ptrdiff_t stride)
    : m_data(data),
      m_width(width),
      m_height(height),
      m_stride(stride),
      m_buckets(kBuckets) {
    for_each([this](uint32_t bits, float) {
        ++m_buckets[bits >> 16];
        m_zeros += bits == 0;
    });
    m_count = std::accumulate(m_buckets.begin(), m_buckets.end(), int64_t(0));
}

std::vector<uint32_t> OrderStatistics::bucket_values(size_t bucket) const {
    std::vector<uint32_t> counts(kLow);
    for_each([&](uint32_t bits, float) {
        if (bits >> 16 == bucket)
            ++counts[bits & (kLow - 1)];
    });
    return counts;
}

float OrderStatistics::at_rank(int64_t rank) const {
    if (m_count == 0)
        return 0;
    rank = std::clamp<int64_t>(rank, 0, m_count - 1);
    size_t bucket = 0;
    for (; rank >= m_buckets[bucket]; ++bucket)
        rank -= m_buckets[bucket];
    const auto counts = bucket_values(bucket);
    size_t low = 0;
    for (; rank >= int64_t(counts[low]); ++low)
        rank -= int64_t(counts[low]);
    return float_of(uint32_t(bucket << 16 | low));
}

float OrderStatistics::percentile(double share) const {
    return at_rank(int64_t(std::ceil(share * double(m_count))) - 1);
}

const std::vector<double>& OrderStatistics::masses() const {
    if (m_masses.empty()) {
        m_masses.resize(kBuckets);
        for_each([this](uint32_t bits, float value) { m_masses[bits >> 16] += double(value); });
    }
    return m_masses;
}

float OrderStatistics::weighted_percentile(double share) const {
    const auto& mass = masses();
    const double target = share * std::accumulate(mass.begin(), mass.end(), 0.0);
    double running = 0;
    size_t last = 0; // the last bucket that adds anything, for a target that rounding put above all
    for (size_t bucket = 0; bucket < kBuckets; ++bucket) {
        if (mass[bucket] <= 0)
            continue;
        last = bucket;
        if (running + mass[bucket] > target)
            break;
        running += mass[bucket];
    }
    const auto counts = bucket_values(last);
    float value = 0;
    for (size_t low = 0; low < kLow; ++low) {
        if (counts[low] == 0)
            continue;
        value = float_of(uint32_t(last << 16 | low));
        running += double(counts[low]) * double(value);
        if (running > target)
            break;
    }
    return value;
}

} // namespace tonetool::metrics
