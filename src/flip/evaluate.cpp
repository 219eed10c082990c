// SPDX-License-Identifier: BSD-3-Clause
#include "flip/evaluate.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "flip/filters.h"
#include "kernels/flip_tile.h"

namespace tonetool::flip {
namespace {

using kernels::FlipTile;
using kernels::Window;

// The rows that are in use must stay in a core's L2 cache, but narrow or low tiles spend their time
// on halos. Enough tiles remain for all threads to end at about the same time.
constexpr int kTileWidth = 640, kTileHeight = 128;
// The same for several tests at a time, each with rows of its own.
constexpr int kNarrowTileWidth = 384, kNarrowFrom = 3;

int parts_of(int length, int size) {
    return (length + size - 1) / size;
}

// `length` in equal parts of about `wanted`.
int part_size(int length, int wanted) {
    return parts_of(length, parts_of(length, wanted));
}

// Tiles have whole strips, none shorter than the halo, also the last one of a row: of the widths up
// to the wanted one that with which the fewest columns are filtered.
int tile_width(int width, int wanted, int halo) {
    constexpr int step = int(kernels::kMostLanes) * kernels::kStripStep;
    const int widest = parts_of(std::min(width, wanted), step) * step;
    const auto filtered = [width, halo](int columns) {
        return int64_t(parts_of(width, columns)) * (columns + 2 * halo);
    };
    int best = widest;
    const int narrowest = std::max(widest / 2, int(kernels::kMostLanes) * halo);
    for (int columns = widest - step; columns >= narrowest; columns -= step)
        if (filtered(columns) < filtered(best))
            best = columns;
    return best;
}

Window tile_size(const Evaluation& what, int width, int height, size_t tests) {
    const int halo = filter_radius(what.taps);
    const int columns = tests >= kNarrowFrom ? kNarrowTileWidth : kTileWidth;
    const int rows =
        what.most_tile_rows > 0 ? what.most_tile_rows : std::max(kTileHeight, 8 * halo);
    return {0, 0, tile_width(width, std::max(columns, 16 * halo), halo), part_size(height, rows)};
}

const kernels::FlipRows& functions_of(const Evaluation& what) {
    return what.functions ? *what.functions : kernels::flip_rows();
}

// Evaluates tiles in parallel: each takes a work space that is free, or makes one.
class Tiles {
public:
    Tiles(const Evaluation& what, const kernels::ConstRgb& reference,
          const std::vector<kernels::ConstRgb>& tests, const Window& window,
          const std::vector<Output>& outputs)
        : m_what(what),
          m_reference(reference),
          m_tests(tests),
          m_window(window),
          m_outputs(outputs),
          m_functions(functions_of(what)),
          m_size(tile_size(what, window.width, window.height, tests.size())),
          m_across((window.width + m_size.width - 1) / m_size.width),
          m_down((window.height + m_size.height - 1) / m_size.height) {
        for (const Output& output : outputs)
            m_keep_each = m_keep_each || !output.per_exposure.empty();
    }

    int64_t count() const { return int64_t(m_across) * m_down; }

    void run(int64_t i) {
        Window tile{int(i % m_across) * m_size.width, int(i / m_across) * m_size.height, 0, 0};
        tile.width = std::min(m_size.width, m_window.width - tile.x0);
        tile.height = std::min(m_size.height, m_window.height - tile.y0);
        tile.x0 += m_window.x0;
        tile.y0 += m_window.y0;
        const std::vector<size_t> differing = split_off_same(tile);
        if (differing.empty())
            return;
        std::unique_ptr<FlipTile> space = take();
        evaluate(*space, tile, differing);
        give_back(std::move(space));
    }

private:
    // The tests that differ from the reference; the others' error is 0.
    std::vector<size_t> split_off_same(const Window& tile) const {
        std::vector<size_t> differing;
        for (size_t t = 0; t < m_tests.size(); ++t)
            if (same_pixels(m_reference, m_tests[t], tile, filter_radius(m_what.taps)))
                clear(m_outputs[t], tile);
            else
                differing.push_back(t);
        return differing;
    }

    void evaluate(FlipTile& space, const Window& tile, const std::vector<size_t>& differing) const {
        std::vector<const kernels::ConstRgb*> tests;
        for (size_t t : differing)
            tests.push_back(&m_tests[t]);
        space.load(tile, m_reference, tests);
        for (size_t n = 0; n < m_what.stops.size(); ++n) {
            space.expose(m_what.curve, float(std::exp2(m_what.stops[n])), float(n), m_what.rows);
            for (size_t i = 0; i < differing.size(); ++i)
                if (const Output& output = m_outputs[differing[i]]; !output.per_exposure.empty())
                    store(space, i, FlipTile::kLastError, tile, output.per_exposure[n], output);
        }
        for (size_t i = 0; i < differing.size(); ++i) {
            const Output& output = m_outputs[differing[i]];
            store(space, i, FlipTile::kError, tile, output.error, output);
            if (output.index)
                store(space, i, FlipTile::kIndex, tile, output.index, output);
        }
    }

    float* place(float* plane, const Window& tile, const Output& output) const {
        return plane + (tile.y0 - m_window.y0) * output.stride + (tile.x0 - m_window.x0);
    }

    void store(FlipTile& space, size_t i, FlipTile::ResultPlane from, const Window& tile, float* to,
               const Output& output) const {
        space.store(i, from, place(to, tile, output), output.stride);
    }

    void clear(const Output& output, const Window& tile) const {
        std::vector<float*> planes = output.per_exposure;
        planes.push_back(output.error);
        if (output.index)
            planes.push_back(output.index);
        for (float* plane : planes)
            for (int y = 0; y < tile.height; ++y)
                std::fill_n(place(plane, tile, output) + y * output.stride, tile.width, 0.0f);
    }

    std::unique_ptr<FlipTile> take() {
        {
            const std::lock_guard<std::mutex> hold(m_lock);
            if (!m_free.empty()) {
                auto space = std::move(m_free.back());
                m_free.pop_back();
                return space;
            }
        }
        const kernels::TileShape shape(m_functions.lanes, m_size.width, m_size.height,
                                       filter_radius(m_what.taps));
        return std::make_unique<FlipTile>(m_functions, shape, m_what.taps, m_tests.size(),
                                          m_keep_each);
    }

    void give_back(std::unique_ptr<FlipTile> space) {
        const std::lock_guard<std::mutex> hold(m_lock);
        m_free.push_back(std::move(space));
    }

    const Evaluation& m_what;
    const kernels::ConstRgb& m_reference;
    const std::vector<kernels::ConstRgb>& m_tests;
    Window m_window;
    const std::vector<Output>& m_outputs;
    const kernels::FlipRows& m_functions;
    Window m_size; // of a tile
    int m_across, m_down;
    bool m_keep_each = false;
    std::mutex m_lock;
    std::vector<std::unique_ptr<FlipTile>> m_free;
};

} // namespace

void evaluate(const Evaluation& what, const kernels::ConstRgb& reference,
              const std::vector<kernels::ConstRgb>& tests, const kernels::Window& window,
              const std::vector<Output>& outputs, const kernels::ParallelFor& parallel) {
    Tiles tiles(what, reference, tests, window, outputs);
    parallel(tiles.count(), [&tiles](int64_t i) { tiles.run(i); });
}

size_t work_bytes(const Evaluation& what, int width, size_t tests, bool keep_each) {
    constexpr int enough = 1 << 20;
    const Window size = tile_size(what, width, enough, tests);
    const kernels::TileShape shape(functions_of(what).lanes, size.width, size.height,
                                   filter_radius(what.taps));
    return FlipTile::bytes(shape, tests, keep_each);
}

} // namespace tonetool::flip
