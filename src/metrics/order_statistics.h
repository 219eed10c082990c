// SPDX-License-Identifier: BSD-3-Clause
// Exact order statistics of non-negative floats, without sorting or copying them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/views.h"

namespace tonetool::metrics {

/// Which element of the sorted values is wanted.
struct Wanted {
    enum class By { Rank, Share, Mass } by;
    int64_t at = 0;
    double part = 0;

    /// Element of this rank, 0 the smallest; the rank is brought into range.
    static Wanted rank(int64_t rank) { return {By::Rank, rank, 0}; }
    /// Nearest rank: the smallest element with at least the given share of all at or below it.
    static Wanted percentile(double share) { return {By::Share, 0, share}; }
    /// The smallest element at which the running sum of the sorted elements exceeds the given share
    /// of the total; 0 if the total is 0.
    static Wanted weighted_percentile(double share) { return {By::Mass, 0, share}; }
};

/// The bits of non-negative floats sort as the floats do: one pass counts by the upper 16 bits, a
/// second one over single buckets finds the values. NaN, infinite and negative values are not
/// counted. Every count and every sum is an integer: the schedule does not enter the result.
/// The view must outlive the object.
class OrderStatistics {
public:
    /// Weighted percentiles need the sums of the buckets, which the first pass then makes, too.
    enum class Keep { Counts, CountsAndSums };

    OrderStatistics(const float* data, int width, int height, ptrdiff_t stride,
                    const kernels::ParallelFor& parallel, Keep keep = Keep::Counts);

    int64_t count() const { return m_count; }
    int64_t zeros() const { return m_zeros; }

    /// Finds all of these elements in one pass over the data; zeros if nothing was counted.
    std::vector<float> find(const std::vector<Wanted>& wanted) const;

private:
    /// An element as its bucket and its rank or sum within that bucket.
    struct Place {
        size_t bucket = 0;
        int64_t rank = 0; ///< within the bucket, if not by mass
        bool by_mass = false;
        double below = 0, target = 0; ///< sum of the buckets below, and what must be exceeded
    };
    /// Counts by the lower 16 bits, of one bucket after the other.
    using Values = std::vector<uint64_t>;

    template <class Bucket>
    void count_all();
    Place place(const Wanted& wanted) const;
    Place place_of_rank(int64_t rank) const;
    Place place_of_mass(double share) const;
    double mass(size_t bucket) const;
    static float value_at_rank(const Place& place, const uint64_t* counts);
    static float value_at_mass(const Place& place, const uint64_t* counts);
    Values values_of(const std::vector<size_t>& buckets) const;

    const float* m_data;
    int m_width, m_height;
    ptrdiff_t m_stride;
    kernels::ParallelFor m_parallel;
    int64_t m_count = 0, m_zeros = 0;
    std::vector<uint64_t> m_counts; ///< per bucket
    std::vector<uint64_t> m_lows;   ///< sums of the lower 16 bits per bucket, if kept
};

} // namespace tonetool::metrics
