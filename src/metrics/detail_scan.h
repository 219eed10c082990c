// SPDX-License-Identifier: BSD-3-Clause
// How fine the detail of a picture is: medians of the differences of neighbours in stops, which
// tell its noise, its sharpness and a blur along one axis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::metrics {

/// Counts of values of at least 0, in 128 steps to the octave: whole numbers, so the order in which
/// rows are added does not matter.
class StepHistogram {
public:
    using Code = uint16_t;
    static Code code(float value);
    void add(const std::vector<Code>& codes);
    /// The value below which this share of them is, linear within its step; 0 without values.
    double quantile(double share) const;

private:
    std::vector<int64_t> m_counts;
    int64_t m_all = 0;
};

/// A row of luminance, and the same in stops. Luminances below kDark count as that.
struct LightRow {
    static constexpr float kDark = 1e-6f;
    std::vector<float> light, stops;
};
/// Negative values count as 0.
LightRow light_row(std::vector<float> light);

/// What one row adds to a DetailScan.
struct DetailRow {
    std::vector<StepHistogram::Code> fine, coarse, across, down;
};

class DetailScan {
public:
    /// The rows that are looked at for one: kRadius above it and below it.
    static constexpr int kRadius = 3;

    /// `rows`: the row y at kRadius and those around it, null outside of the picture, whose first
    /// row has the number 0.
    static DetailRow scan(const LightRow* const (&rows)[2 * kRadius + 1], int64_t y);
    void add(const DetailRow& row);

    /// Of lit pixels, in stops: the median distance from the mean of the four neighbours.
    double fine() const { return m_fine.quantile(0.5); }
    /// The same of means of 2 x 2 pixels, lit or not.
    double coarse() const { return m_coarse.quantile(0.5); }
    /// The median distance from the pixel to the left, and from that above.
    double across() const { return m_across.quantile(0.5); }
    double down() const { return m_down.quantile(0.5); }

private:
    StepHistogram m_fine, m_coarse, m_across, m_down;
};

} // namespace tonetool::metrics
