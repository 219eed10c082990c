// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels/noise_rows.h"

namespace tonetool::tonemap {
namespace {

constexpr int kRadius = 8, kSide = 2 * kRadius + 1;
// Where fewer than this share of a box is flat, it tells nothing.
constexpr double kLeastFlat = 0.02 * kSide * kSide;
// The difference of a pixel and the mean of four has 1 + 1/4 times the variance of a pixel.
constexpr double kOfDifference = 1 / 1.25;

// Rows of an image whose boxes are summed one after the other, from the first on: the bands begin
// at fixed rows, lest the roundings of sums depend on threads.
constexpr int kBand = 120;

class Band {
public:
    explicit Band(const kernels::GuidePlanes& image)
        : m_image(image),
          m_width(size_t(image.width)),
          m_rows(2 * kSide * m_width),
          m_flat(m_width),
          m_square(m_width) {}

    void run(int first, int end, float* noise) {
        for (int y = first - kRadius; y < first + kRadius; ++y)
            add(y, 1);
        for (int y = first; y < end; ++y) {
            add(y + kRadius, 1);
            sum_boxes(noise + size_t(y) * m_width);
            add(y - kRadius, -1);
        }
    }

private:
    // Adds a row to the sums of columns, or takes one away that was added before. Rows beyond the
    // border are those at it.
    void add(int y, int sign) {
        const size_t place = size_t((y + kSide) % kSide);
        float *const flat = &m_rows[2 * place * m_width], *const square = flat + m_width;
        if (sign > 0)
            kernels::noise_row(m_image, std::clamp(y, 0, m_image.height - 1), flat, square);
        for (size_t x = 0; x < m_width; ++x) {
            m_flat[x] += sign * double(flat[x]);
            m_square[x] += sign * double(square[x]);
        }
    }

    void sum_boxes(float* noise) const {
        const int last = m_image.width - 1;
        double flat = 0, square = 0;
        const auto add_column = [&](int x, int sign) {
            const auto i = size_t(std::clamp(x, 0, last));
            flat += sign * m_flat[i];
            square += sign * m_square[i];
        };
        for (int x = -kRadius; x < kRadius; ++x)
            add_column(x, 1);
        for (int x = 0; x <= last; ++x) {
            add_column(x + kRadius, 1);
            noise[x] = flat > kLeastFlat ? float(kOfDifference * std::max(square, 0.0) / flat)
                                         : std::numeric_limits<float>::quiet_NaN();
            add_column(x - kRadius, -1);
        }
    }

    const kernels::GuidePlanes& m_image;
    size_t m_width;
    std::vector<float> m_rows; ///< of f and of f h^2, as many as a box is high
    std::vector<double> m_flat, m_square;
};

} // namespace

void noise_plane(const kernels::GuidePlanes& image, float* noise,
                 const kernels::ParallelFor& parallel) {
    parallel((image.height + kBand - 1) / kBand, [&](int64_t i) {
        const int first = int(i) * kBand;
        Band(image).run(first, std::min(first + kBand, image.height), noise);
    });
}

} // namespace tonetool::tonemap
