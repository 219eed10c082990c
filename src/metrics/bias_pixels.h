// SPDX-License-Identifier: BSD-3-Clause
// The pixels of both sides, without those that are not finite.
#pragma once

#include <array>
#include <vector>

#include "metrics/bias.h"

namespace tonetool::metrics::bias {

/// Pixels of some cells beside each other: r of the reference, d = test - reference, of Y, R, G, B.
/// As many as stay in the cache, in rows that are long enough for vectors.
struct Strip {
    static constexpr int kWidth = 64; ///< from row to row
    static constexpr int kRows = 24;  ///< cells have fewer columns and rows than this

    kernels::Window window;
    double r[kBiasChannels][kRows * kWidth];
    double d[kBiasChannels][kRows * kWidth];
    const uint8_t* ignored; ///< of the first pixel; null: all count
    ptrdiff_t ignored_step; ///< from row to row
};

class Pixels {
public:
    Pixels(const BiasSide& reference, const BiasSide& test, const uint8_t* ignored = nullptr);

    int width() const { return m_reference.width(); }
    int height() const { return m_reference.height(); }

    /// Luminance of a row of both sides, 0 where a channel of either is not finite. Rows must be
    /// seen by this before any other function is asked for them.
    void luminance(int y, double* r, double* t);

    /// 1 for each pixel of a row that does not count; null: all count.
    const uint8_t* ignored(int y) const {
        return m_ignored ? m_ignored + ptrdiff_t(y) * width() : nullptr;
    }
    /// Pixels that count.
    int64_t counted() const;

    /// Pixels that are not finite, of the rows seen.
    int64_t nonfinite() const;

    /// Of a window that fits.
    void strip(const kernels::Window& window, Strip& out) const;

    /// R, G, B of a row of the reference and of the test, as strip() has them.
    void row(int y, int x, int count, double* const r[3], double* const t[3]) const;

    /// Both sides have independent halves; the products of their differences in luminance.
    bool has_halves() const { return m_reference.has_halves() && m_test.has_halves(); }
    void half_products(int y, double* out) const;

private:
    const BiasSide& m_reference;
    const BiasSide& m_test;
    const uint8_t* m_ignored;
    std::vector<int> m_bad; // pixels of each row that are not finite
};

/// Rec.709 luminance of three rows.
void luminance_row(const double* const rgb[3], int count, double* out);

} // namespace tonetool::metrics::bias
