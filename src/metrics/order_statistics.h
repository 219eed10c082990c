// Exact order statistics of non-negative floats, without sorting or copying them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::metrics {

/// The bits of non-negative floats sort as the floats do: one pass counts by the upper 16 bits, a
/// second one over a single bucket finds the value. NaN and infinite values are not counted. The
/// view must outlive the object.
class OrderStatistics {
public:
    OrderStatistics(const float* data, int width, int height, ptrdiff_t stride);

    int64_t count() const { return m_count; }
    int64_t zeros() const { return m_zeros; }

    /// Element of the given rank, 0 the smallest; the rank is brought into range. 0 if empty.
    float at_rank(int64_t rank) const;
    /// Nearest rank: the smallest element with at least the given share of all at or below it.
    float percentile(double share) const;
    /// The smallest element at which the running sum of the sorted elements exceeds the given share
    /// of the total; 0 if the total is 0.
    float weighted_percentile(double share) const;

private:
    std::vector<uint32_t> bucket_values(size_t bucket) const;
    const std::vector<double>& masses() const;
    template <class F>
    void for_each(const F& visit) const;

    const float* m_data;
    int m_width, m_height;
    ptrdiff_t m_stride;
    int64_t m_count = 0, m_zeros = 0;
    std::vector<int64_t> m_buckets;
    mutable std::vector<double> m_masses; // sums per bucket, in scan-line order, made when needed
};

} // namespace tonetool::metrics
