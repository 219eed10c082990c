// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/base.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "kernels/guided_tile.h"

namespace tonetool::tonemap {
namespace {

using kernels::GuidedTile;
using kernels::kGuidedRun;
using kernels::Window;

// The rows of a tile must stay in a core's L2 cache; the rows above and beside it are prepared for
// it alone. Tiles are low enough for all threads to end at about the same time.
constexpr int kTileWidth = 7 * kGuidedRun, kTileHeight = 540;

// Filters tiles in parallel: each takes a work space that is free, or makes one.
class Tiles {
public:
    using Work = std::function<void(GuidedTile& space, const Window& tile)>;

    Tiles(const kernels::GuidePlanes& image, const kernels::GuidedTerms& terms,
          const kernels::TapSets& taps, const Window& window, const Work& work)
        : m_image(image),
          m_terms(terms),
          m_taps(taps),
          m_window(window),
          m_work(work),
          m_first(window.x0 / kGuidedRun * kGuidedRun),
          m_across((window.x0 + window.width - m_first + kTileWidth - 1) / kTileWidth),
          m_down((window.height + kTileHeight - 1) / kTileHeight),
          m_height((window.height + m_down - 1) / m_down) {}

    int64_t count() const { return int64_t(m_across) * m_down; }

    void run(int64_t i) {
        const int left = m_first + int(i % m_across) * kTileWidth;
        const int x0 = std::max(left, m_window.x0);
        const int x1 = std::min(left + kTileWidth, m_window.x0 + m_window.width);
        const int y0 = int(i / m_across) * m_height;
        const int y1 = std::min(y0 + m_height, m_window.height);
        auto space = take();
        m_work(*space, {x0, m_window.y0 + y0, x1 - x0, y1 - y0});
        const std::lock_guard<std::mutex> hold(m_lock);
        m_free.push_back(std::move(space));
    }

private:
    std::unique_ptr<GuidedTile> take() {
        {
            const std::lock_guard<std::mutex> hold(m_lock);
            if (!m_free.empty()) {
                auto space = std::move(m_free.back());
                m_free.pop_back();
                return space;
            }
        }
        return std::make_unique<GuidedTile>(m_image, m_terms, m_taps, kTileWidth);
    }

    const kernels::GuidePlanes& m_image;
    const kernels::GuidedTerms& m_terms;
    const kernels::TapSets& m_taps;
    Window m_window;
    const Work& m_work;
    int m_first; ///< column that tiles are counted from
    int m_across, m_down, m_height;
    std::mutex m_lock;
    std::vector<std::unique_ptr<GuidedTile>> m_free;
};

void each_tile(const kernels::GuidePlanes& image, const kernels::GuidedTerms& terms,
               const kernels::TapSets& taps, const Window& window,
               const kernels::ParallelFor& parallel, const Tiles::Work& work) {
    if (window.width <= 0 || window.height <= 0)
        return;
    Tiles tiles(image, terms, taps, window, work);
    parallel(tiles.count(), [&tiles](int64_t i) { tiles.run(i); });
}

} // namespace

void filter_base(const kernels::GuidePlanes& image, const kernels::GuidedTerms& terms,
                 const kernels::TapSets& taps, const Window& window, const kernels::GuidedRow& row,
                 const kernels::ParallelFor& parallel) {
    each_tile(image, terms, taps, window, parallel,
              [&row](GuidedTile& space, const Window& tile) { space.filter(tile, row); });
}

void filter_moments(const kernels::GuidePlanes& image, const kernels::GuidedTerms& terms,
                    const kernels::TapSets& taps, const Window& window,
                    const kernels::MomentsRow& row, const kernels::ParallelFor& parallel) {
    each_tile(image, terms, taps, window, parallel,
              [&row](GuidedTile& space, const Window& tile) { space.moments(tile, row); });
}

void filter_base(const kernels::GuidePlanes& image, const kernels::GuidedTerms& terms,
                 const kernels::TapSets& taps, const Window& window, float* out, ptrdiff_t stride,
                 const kernels::ParallelFor& parallel) {
    const auto copy = [&](int x0, int y, int count, const float* base) {
        std::copy_n(base, count, out + (y - window.y0) * stride + (x0 - window.x0));
    };
    filter_base(image, terms, taps, window, copy, parallel);
}

} // namespace tonetool::tonemap
