// SPDX-License-Identifier: BSD-3-Clause
// The cross bilateral filter over some columns of an image, row by row.
#pragma once

#include <functional>
#include <hwy/aligned_allocator.h>
#include <vector>

#include "kernels/guided_rows.h"
#include "kernels/views.h"

namespace tonetool::kernels {

/// Takes `count` pixels of row y from x0 on.
using GuidedRow = std::function<void(int x0, int y, int count, const float* base)>;

/// The same of the weighted means and variances.
using MomentsRow =
    std::function<void(int x0, int y, int count, const float* mean, const float* variance)>;

/// Work space of one thread: as many prepared rows as the window of the filter is high, so that a
/// core's L2 cache holds them.
class GuidedTile {
public:
    /// For windows of at most `columns`. The arguments must outlive this object.
    GuidedTile(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
               int columns);

    /// Filters a window of the image and hands out its rows from the top. Where the value itself is
    /// not one to be averaged it is copied.
    void filter(const Window& window, const GuidedRow& row);

    /// The same with variances; the image has no range. Where the value is copied, the variance is
    /// 0.
    void moments(const Window& window, const MomentsRow& row);

    static size_t bytes(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                        int columns);

private:
    void prepare(int y, int x0, int columns);
    float* row_of(int y) const;
    void fetch(int y, int x, bool leftmost, bool rightmost) const;
    bool counts(float value, float range) const;
    void each_row(const Window& window, const std::function<void(int y, int x0)>& run);
    void filter_row(int y, const Window& window, int x0, float* out, float* variance);

    const GuidePlanes& m_image;
    const TapSets& m_taps;
    const GuidedRows& m_rows;
    GuidedLayout m_layout;
    GuidedScales m_scales;
    ptrdiff_t m_lead; ///< columns before the first one
    hwy::AlignedFreeUniquePtr<float[]> m_data;
    std::vector<const float*> m_table;         ///< the rows around the one that is filtered
    std::vector<float> m_filtered, m_variance; ///< a row
};

} // namespace tonetool::kernels
