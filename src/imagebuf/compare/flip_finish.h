// SPDX-License-Identifier: BSD-3-Clause
// From the planes of a comparison, band by band, to its map, summary and exposures.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <vector>

#include "imagebuf/compare/flip_plan.h"
#include "imagebuf/compare/pair.h"

namespace tonetool {

/// Bytes of all results of one test per pixel.
size_t map_bytes(const FlipPlan& plan, size_t exposures);

/// What was found of one test beside its map.
struct Found {
    NonfiniteBoth nonfinite;
    int64_t alpha_ignored = 0; ///< pixels whose alpha differs and is not compared
    std::vector<std::string> notes;
    std::optional<double> ignored; ///< share of the pixels that do not count
};

/// The results of one test over the pixels asked for: filled band by band, then finished.
class FlipMaps {
public:
    /// `roi` are the pixels of the maps, `full` their display window. The map goes into the pixels
    /// of `dst` if they are a plane of that size or larger, else into pixels of its own.
    FlipMaps(const FlipPlan& plan, const Exposures& exposures, const OIIO::ROI& roi,
             const OIIO::ROI& full, OIIO::ImageBuf& dst, int nthreads);

    /// Where rows from `y` on are to be evaluated to.
    flip::Output output(int y);
    /// Rows of the roi that have been evaluated from these planes: lets alpha and non-finite pixels
    /// enter the map, counts, makes the pictures that were asked for.
    void take(int begin, int end, const ColorPlanes& reference, const ColorPlanes& test);
    /// Pools; the counts of the planes are complete. Leaves the map in `map`, unless the
    /// plan only shows.
    void finish(const ColorPlanes& reference, const ColorPlanes& test, const Found& found,
                OIIO::ImageBuf& map, FlipResult& result);

private:
    struct AlphaRow {
        double sum = 0, max = 0;
        int max_x = 0;
    };
    /// Pixels that differ, and those of them whose difference no exposure shows.
    struct Unseen {
        int64_t differing = 0, white = 0, black = 0;
    };
    struct Clipping {
        float white = 0, black = 0;
    };
    struct Sides {
        const ColorPlanes& reference;
        const ColorPlanes& test;
    };

    OIIO::ImageBuf make_image(int channels) const;
    float* row(OIIO::ImageBuf& image, int y) const;
    void compare_alpha(int y, const Sides& sides);
    /// Pixels of a row that count and that the test alone has lost, and the first of them.
    struct Lost {
        int64_t count = 0;
        int x = 0;
    };
    Lost override_nonfinite(int y, const Sides& sides);
    void clear_ignored(int y, const IgnoredPixels& ignored);
    void mark_ignored(const IgnoredPixels& ignored, float value);
    FlipPool pooled(const IgnoredPixels* ignored);
    void pool_lost(FlipPool& pool, metrics::PoolRequest& further) const;
    Clipping clipping() const;
    Unseen unseen(int y, const Sides& sides) const;
    void count_hidden(const std::vector<float> (&pixels)[2][3], Unseen& found) const;
    void show(const float* const (&in)[3], size_t count, double stops,
              std::vector<float> (&out)[3]) const;
    void tone_map_row(int y, double stops, const ColorPlanes& planes, OIIO::ImageBuf& image) const;
    FlipSummary summarize(const Sides& sides, const Found& found);
    void warn_of_unseen(const Sides& sides, FlipSummary& summary) const;
    void warn_of_clipped(FlipSummary& summary) const;
    void resolve_largest();
    void make_stops();

    const FlipPlan& m_plan;
    const Exposures& m_exposures;
    OIIO::ROI m_roi, m_full;
    int m_nthreads;
    bool m_unbounded; ///< the largest error is known only in the end
    OIIO::ImageBuf m_error, m_index, m_stops;
    std::vector<FlipExposure> m_pictures;
    std::vector<AlphaRow> m_alpha;
    Unseen m_unseen;
    int64_t m_lost = 0;             ///< pixels that are non-finite in the test alone
    int m_lost_x = 0, m_lost_y = 0; ///< the first of them
    Clipping m_clipping;
};

} // namespace tonetool
