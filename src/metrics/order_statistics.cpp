// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/order_statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>
#include <type_traits>

#include "metrics/blocks.h"

namespace tonetool::metrics {
namespace {

constexpr uint32_t kInfinity = 0x7f800000u;
constexpr size_t kBuckets = kInfinity >> 16;
constexpr size_t kLow = size_t(1) << 16;

uint32_t bits_of(float value) {
    uint32_t bits = 0;
    value += 0.0f; // -0 becomes 0
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

float float_of(size_t bucket, size_t low) {
    const auto bits = uint32_t(bucket << 16 | low);
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

// A float is an integer times a power of two that all floats of its bucket share.
struct Scale {
    uint64_t base; // the integer of the smallest value
    double unit;   // the power of two
};

Scale scale_of(size_t bucket) {
    const auto exponent = int(bucket >> 7);
    const uint64_t leading = exponent ? 128 : 0;
    return {(leading | (bucket & 127)) << 16, std::ldexp(1.0, std::max(exponent, 1) - 150)};
}

struct Count {
    uint64_t count = 0;
    void add(uint32_t) { ++count; }
};

struct CountAndSum {
    uint64_t count = 0, lows = 0;
    void add(uint32_t bits) {
        ++count;
        lows += bits & (kLow - 1);
    }
};

// Neighbours are often equal: two tables by turns, so that an increment need not wait for the one
// before. The last bucket is for what is not counted.
template <class Bucket>
struct Table {
    std::vector<Bucket> even = std::vector<Bucket>(kBuckets + 1), odd = even;
    int64_t zeros = 0;

    void add(const float* row, int width) {
        int64_t none = 0;
        const auto one = [&none](Bucket* buckets, float value) {
            const uint32_t bits = bits_of(value);
            none += bits == 0;
            buckets[std::min(bits, kInfinity) >> 16].add(bits);
        };
        int x = 0;
        for (; x + 1 < width; x += 2) {
            one(even.data(), row[x]);
            one(odd.data(), row[x + 1]);
        }
        if (x < width)
            one(even.data(), row[x]);
        zeros += none;
    }
};

} // namespace

OrderStatistics::OrderStatistics(const float* data, int width, int height, ptrdiff_t stride,
                                 const kernels::ParallelFor& parallel, Keep keep)
    : m_data(data),
      m_width(width),
      m_height(height),
      m_stride(stride),
      m_parallel(parallel),
      m_counts(kBuckets),
      m_lows(keep == Keep::CountsAndSums ? kBuckets : 0) {
    if (keep == Keep::CountsAndSums)
        count_all<CountAndSum>();
    else
        count_all<Count>();
    m_count = int64_t(std::accumulate(m_counts.begin(), m_counts.end(), uint64_t(0)));
}

template <class Bucket>
void OrderStatistics::count_all() {
    Accumulators<Table<Bucket>> tables([] { return Table<Bucket>(); });
    for_each_block(m_width, m_height, m_parallel, [&](int first, int end) {
        tables.with_one([&](Table<Bucket>& table) {
            for (int y = first; y < end; ++y)
                table.add(m_data + y * m_stride, m_width);
        });
    });
    for (const auto& table : tables.all()) {
        m_zeros += table->zeros;
        for (size_t i = 0; i < kBuckets; ++i) {
            m_counts[i] += table->even[i].count + table->odd[i].count;
            if constexpr (std::is_same_v<Bucket, CountAndSum>)
                m_lows[i] += table->even[i].lows + table->odd[i].lows;
        }
    }
}

OrderStatistics::Place OrderStatistics::place_of_rank(int64_t rank) const {
    Place out;
    out.rank = std::clamp<int64_t>(rank, 0, m_count - 1);
    for (; out.rank >= int64_t(m_counts[out.bucket]); ++out.bucket)
        out.rank -= int64_t(m_counts[out.bucket]);
    return out;
}

double OrderStatistics::mass(size_t bucket) const {
    if (m_counts[bucket] == 0)
        return 0;
    const Scale scale = scale_of(bucket);
    return double(m_counts[bucket] * scale.base + m_lows[bucket]) * scale.unit;
}

OrderStatistics::Place OrderStatistics::place_of_mass(double share) const {
    assert(!m_lows.empty());
    double total = 0;
    for (size_t bucket = 0; bucket < kBuckets; ++bucket)
        total += mass(bucket);
    Place out;
    out.by_mass = true;
    out.target = share * total;
    double running = 0;
    for (size_t bucket = 0; bucket < kBuckets; ++bucket) {
        const double here = mass(bucket);
        if (here <= 0)
            continue;
        out.bucket = bucket; // if rounding put the target above all: the last one with any mass
        out.below = running;
        running += here;
        if (running > out.target)
            break;
    }
    return out;
}

OrderStatistics::Place OrderStatistics::place(const Wanted& wanted) const {
    switch (wanted.by) {
    case Wanted::By::Rank:
        return place_of_rank(wanted.at);
    case Wanted::By::Share:
        return place_of_rank(int64_t(std::ceil(wanted.part * double(m_count))) - 1);
    case Wanted::By::Mass:
        break;
    }
    return place_of_mass(wanted.part);
}

OrderStatistics::Values OrderStatistics::values_of(const std::vector<size_t>& buckets) const {
    std::vector<uint8_t> slots(kBuckets + 1); // 1 + index into `buckets`, 0 for the others
    for (size_t i = 0; i < buckets.size(); ++i)
        slots[buckets[i]] = uint8_t(i + 1);
    Accumulators<Values> tables([&] { return Values(buckets.size() * kLow); });
    for_each_block(m_width, m_height, m_parallel, [&](int first, int end) {
        tables.with_one([&](Values& counts) {
            for (int y = first; y < end; ++y)
                for (int x = 0; x < m_width; ++x) {
                    const uint32_t bits = bits_of(m_data[y * m_stride + x]);
                    const size_t slot = slots[std::min(bits, kInfinity) >> 16];
                    if (slot)
                        ++counts[(slot - 1) * kLow + (bits & (kLow - 1))];
                }
        });
    });
    Values out = std::move(*tables.all().front());
    for (size_t t = 1; t < tables.all().size(); ++t)
        for (size_t i = 0; i < out.size(); ++i)
            out[i] += (*tables.all()[t])[i];
    return out;
}

float OrderStatistics::value_at_rank(const Place& place, const uint64_t* counts) {
    size_t low = 0;
    for (int64_t rank = place.rank; rank >= int64_t(counts[low]); ++low)
        rank -= int64_t(counts[low]);
    return float_of(place.bucket, low);
}

float OrderStatistics::value_at_mass(const Place& place, const uint64_t* counts) {
    const Scale scale = scale_of(place.bucket);
    uint64_t sum = 0;
    size_t last = 0;
    for (size_t low = 0; low < kLow; ++low) {
        if (counts[low] == 0)
            continue;
        last = low;
        sum += counts[low] * (scale.base + low);
        if (place.below + double(sum) * scale.unit > place.target)
            break;
    }
    return float_of(place.bucket, last);
}

std::vector<float> OrderStatistics::find(const std::vector<Wanted>& wanted) const {
    std::vector<float> out(wanted.size(), 0.0f);
    if (m_count == 0)
        return out;
    // Black images and maps of equal ones need no second look.
    const bool only_zeros_below = m_counts[0] == uint64_t(m_zeros);
    const auto is_zero = [&](const Place& at) { return at.bucket == 0 && only_zeros_below; };
    std::vector<Place> places;
    std::vector<size_t> buckets;
    for (const Wanted& w : wanted) {
        places.push_back(place(w));
        if (!is_zero(places.back()))
            buckets.push_back(places.back().bucket);
    }
    if (buckets.empty())
        return out;
    std::sort(buckets.begin(), buckets.end());
    buckets.erase(std::unique(buckets.begin(), buckets.end()), buckets.end());
    assert(buckets.size() < 256);
    const auto values = values_of(buckets);
    for (size_t i = 0; i < places.size(); ++i) {
        if (is_zero(places[i]))
            continue;
        const auto at = std::lower_bound(buckets.begin(), buckets.end(), places[i].bucket);
        const uint64_t* counts = values.data() + size_t(at - buckets.begin()) * kLow;
        out[i] =
            places[i].by_mass ? value_at_mass(places[i], counts) : value_at_rank(places[i], counts);
    }
    return out;
}

} // namespace tonetool::metrics
