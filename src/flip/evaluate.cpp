#include "flip/evaluate.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "flip/filters.h"
#include "kernels/flip_tile.h"

namespace tonetool::flip {
namespace {

using kernels::FlipTile;
using kernels::Planes;
using kernels::TilePixels;
using kernels::TileShape;
using kernels::Window;

// Work space of a tile stays within a core's L2 cache at common viewing conditions; wide halos get
// larger tiles so that the halo does not become most of the work.
int tile_size(int halo) {
    return std::clamp((4 * halo + 15) / 16 * 16, 96, 384);
}

// One test against the reference within a tile.
struct TestTile {
    TilePixels pixels;
    Planes best; // error and index
    bool identical;
};

class TileRun {
public:
    TileRun(const Evaluation& what, const kernels::ConstRgb& reference,
            const std::vector<kernels::ConstRgb>& tests, const std::vector<Output>& outputs,
            const Window& window, const Window& tile)
        : m_what(what),
          m_outputs(outputs),
          m_shape(tile.width, tile.height, reach(what.taps)),
          m_reference(m_shape, reference, tile.x0, tile.y0),
          m_column(tile.x0 - window.x0),
          m_row(tile.y0 - window.y0) {
        for (const auto& test : tests) {
            TilePixels pixels(m_shape, test, tile.x0, tile.y0);
            const bool identical = pixels.same_as(m_reference);
            m_tests.push_back(
                {std::move(pixels), Planes(2, m_shape.stride, m_shape.height), identical});
        }
    }

    void run() {
        const bool all_identical = std::all_of(m_tests.begin(), m_tests.end(),
                                               [](const TestTile& t) { return t.identical; });
        if (!all_identical)
            evaluate_exposures();
        else
            clear_per_exposure();
        for (size_t t = 0; t < m_tests.size(); ++t) {
            store(m_tests[t].best[0], m_outputs[t].error, m_outputs[t]);
            if (m_outputs[t].index)
                store(m_tests[t].best[1], m_outputs[t].index, m_outputs[t]);
        }
    }

private:
    void evaluate_exposures() {
        FlipTile tile(m_shape, m_what.taps);
        Planes reference(kernels::kFeaturePlanes, m_shape.stride, m_shape.height);
        Planes features(kernels::kFeaturePlanes, m_shape.stride, m_shape.height);
        Planes error(1, m_shape.stride, m_shape.height);
        for (size_t n = 0; n < m_what.stops.size(); ++n) {
            const auto scale = float(std::exp2(m_what.stops[n]));
            tile.prepare(m_reference, m_what.curve, scale, reference);
            for (size_t t = 0; t < m_tests.size(); ++t) {
                const bool keep = !m_outputs[t].per_exposure.empty();
                if (m_tests[t].identical && !keep)
                    continue;
                tile.prepare(m_tests[t].pixels, m_what.curve, scale, features);
                tile.compare(reference, features, float(n), m_tests[t].best[0], m_tests[t].best[1],
                             keep ? error[0] : nullptr);
                if (keep)
                    store(error[0], m_outputs[t].per_exposure[n], m_outputs[t]);
            }
        }
    }

    void clear_per_exposure() {
        const Planes zero(1, m_shape.stride, m_shape.height);
        for (const Output& output : m_outputs)
            for (float* plane : output.per_exposure)
                store(zero[0], plane, output);
    }

    void store(const float* from, float* plane, const Output& output) const {
        for (int y = 0; y < m_shape.height; ++y)
            std::copy_n(from + y * m_shape.stride, m_shape.width,
                        plane + (m_row + y) * output.stride + m_column);
    }

    const Evaluation& m_what;
    const std::vector<Output>& m_outputs;
    TileShape m_shape;
    TilePixels m_reference;
    std::vector<TestTile> m_tests;
    int m_column, m_row;
};

} // namespace

void evaluate(const Evaluation& what, const kernels::ConstRgb& reference,
              const std::vector<kernels::ConstRgb>& tests, const kernels::Window& window,
              const std::vector<Output>& outputs, const kernels::ParallelFor& parallel) {
    const int size = tile_size(reach(what.taps));
    const int64_t across = (window.width + size - 1) / size;
    const int64_t down = (window.height + size - 1) / size;
    parallel(across * down, [&](int64_t i) {
        Window tile{int(i % across) * size, int(i / across) * size, 0, 0};
        tile.width = std::min(size, window.width - tile.x0);
        tile.height = std::min(size, window.height - tile.y0);
        tile.x0 += window.x0;
        tile.y0 += window.y0;
        TileRun(what, reference, tests, outputs, window, tile).run();
    });
}

} // namespace tonetool::flip
