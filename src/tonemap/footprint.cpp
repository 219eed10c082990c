// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernels/footprint_rows.h"

namespace tonetool::tonemap {
namespace {

using kernels::GuidePlanes;

using kernels::FootprintRows;
using kernels::kFootprintMargin;
using kernels::kFootprintReach;
using kernels::kFootprintSpread;

// A ring of rows with margins, for a scanline block that is processed downwards.
class Ring {
public:
    Ring(int rows, int width)
        : m_rows(rows),
          m_pitch(size_t(width) + 2 * kFootprintMargin),
          m_data(size_t(rows) * m_pitch) {}
    float* row(int y) {
        const int i = (y % m_rows + m_rows) % m_rows;
        return m_data.data() + size_t(i) * m_pitch + kFootprintMargin;
    }

private:
    int m_rows;
    size_t m_pitch;
    std::vector<float> m_data;
};

// The rows around the current one: positions, the steps between them, and the footprints.
class Band {
public:
    Band(const GuidePlanes& image, double step)
        : m_rows(kernels::footprint_rows()),
          m_image(image),
          m_step(float(step)),
          m_positions{
              {kPositions, image.width}, {kPositions, image.width}, {kPositions, image.width}},
          m_raw(kSide, image.width),
          m_settled(1, image.width) {}

    void run(int first, int end, float* out) {
        clean(first - kFootprintReach - 1);
        clean(first - kFootprintReach);
        for (int y = first - kFootprintReach; y < first + kFootprintReach; ++y)
            step_to(y);
        for (int y = first; y < end; ++y) {
            step_to(y + kFootprintReach);
            finish(y, out + ptrdiff_t(y) * m_image.width);
        }
    }

private:
    static constexpr int kSide = 2 * kFootprintReach + 1, kPositions = kFootprintReach + 3;

    void clean(int y) {
        float* const to[3] = {m_positions[0].row(y), m_positions[1].row(y), m_positions[2].row(y)};
        m_rows.clean(m_image, y, to);
    }

    // The steps of row y, which needs positions up to the row below.
    void step_to(int y) {
        clean(y + 1);
        const float* rows[3][3];
        for (int dy = -1; dy <= 1; ++dy)
            for (size_t c = 0; c < 3; ++c)
                rows[dy + 1][c] = m_positions[c].row(y + dy);
        m_rows.raw(rows, m_image.width, m_raw.row(y));
    }

    void finish(int y, float* out) {
        const float* raw[kSide];
        for (int dy = -kFootprintReach; dy <= kFootprintReach; ++dy)
            raw[dy + kFootprintReach] = m_raw.row(y + dy);
        const float* const row[3] = {m_positions[0].row(y), m_positions[1].row(y),
                                     m_positions[2].row(y)};
        float* const settled = m_settled.row(0);
        m_rows.settle(raw, row, m_step, m_image.width, settled);
        for (int x = 0; x < m_image.width; ++x)
            out[x] = settled[x] == kernels::kNotSettled ? by_median(raw, row, x) : settled[x];
    }

    float by_median(const float* const (&raw)[kSide], const float* const row[3], int x) const {
        const float median = local_median(raw, x), f = raw[kFootprintReach][x];
        const float most =
            std::max({std::abs(row[0][x]), std::abs(row[1][x]), std::abs(row[2][x])});
        const float within =
            f > 0 ? std::clamp(f, median / kFootprintSpread, median * kFootprintSpread) : median;
        return std::max(within, m_step * most);
    }

    // The median of the known footprints around a pixel, the upper one of two.
    static float local_median(const float* const (&raw)[kSide], int x) {
        std::array<float, size_t(kSide) * kSide> known;
        auto end = known.begin();
        for (const float* row : raw)
            for (int dx = -kFootprintReach; dx <= kFootprintReach; ++dx)
                if (row[x + dx] > 0)
                    *end++ = row[x + dx];
        if (end == known.begin())
            return 0;
        const auto middle = known.begin() + (end - known.begin()) / 2;
        std::nth_element(known.begin(), middle, end);
        return *middle;
    }

    const FootprintRows& m_rows;
    const GuidePlanes& m_image;
    float m_step;
    Ring m_positions[3], m_raw, m_settled;
};

// The height of a scanline block: low enough for all threads to have some, high enough for the rows
// around them to be few.
constexpr int kBandRows = 64;

} // namespace

void footprints(const GuidePlanes& image, double step, float* out,
                const kernels::ParallelFor& parallel) {
    parallel((image.height + kBandRows - 1) / kBandRows, [&](int64_t i) {
        const int first = int(i) * kBandRows;
        Band(image, step).run(first, std::min(first + kBandRows, image.height), out);
    });
}

double median_footprint(const float* plane, int width, int height) {
    std::vector<float> known;
    for (int64_t i = 0; i < int64_t(width) * height; ++i)
        if (plane[i] > 0)
            known.push_back(plane[i]);
    if (known.empty())
        return 0;
    const auto middle = known.begin() + ptrdiff_t(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end());
    return double(*middle);
}

} // namespace tonetool::tonemap
