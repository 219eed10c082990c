// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/tmqi.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "metrics/blocks.h"

namespace tonetool::metrics {
namespace {

using kernels::ParallelFor;

constexpr int kTaps = kTmqiWindow, kRadius = kTaps / 2;
constexpr size_t kScales = std::tuple_size_v<decltype(TmqiScore::scales)>;

// Weights of the scales, which show 16, 8, 4, 2 and 1 cycles per degree.
constexpr double kWeight[kScales] = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
constexpr double kFinestCycles = 16;

// Constants of the structural fidelity.
constexpr double kC1 = 0.01, kC2 = 10;

// Mean and contrast of natural pictures: a normal and a Beta distribution.
constexpr double kMean = 115.94, kMeanSigma = 27.99;
constexpr double kBetaA = 4.4, kBetaB = 10.1, kContrastRange = 64.29;

using Taps = std::array<double, kTaps>;

Taps make_gaussian() {
    constexpr double sigma = 1.5;
    Taps taps{};
    double sum = 0;
    for (int i = 0; i < kTaps; ++i) {
        taps[size_t(i)] = std::exp(-(i - kRadius) * (i - kRadius) / (2 * sigma * sigma));
        sum += taps[size_t(i)];
    }
    for (double& tap : taps)
        tap /= sum;
    return taps;
}

const Taps& gaussian() {
    static const Taps taps = make_gaussian();
    return taps;
}

// Both images at one scale.
struct Scale {
    int width = 0, height = 0;
    /// Writes a row of each.
    std::function<void(int y, double* hdr, double* ldr)> row;
};

// Means, variances and covariance of a window.
struct Moments {
    double h = 0, l = 0, hh = 0, ll = 0, hl = 0;

    void add(double weight, double dh, double dl) {
        h += weight * dh;
        l += weight * dl;
        hh += weight * dh * dh;
        ll += weight * dl * dl;
        hl += weight * dh * dl;
    }
    // From moments about (h0, l0) to central ones.
    void center(double h0, double l0) {
        hh -= h * h;
        ll -= l * l;
        hl -= h * l;
        h += h0;
        l += l0;
    }
};

// Relative to the pixel in the middle: the squares of 32-bit light would hide small variances.
Moments along_row(const Taps& taps, const double* h, const double* l) {
    Moments m;
    for (size_t i = 0; i < kTaps; ++i)
        m.add(taps[i], h[i] - h[kRadius], l[i] - l[kRadius]);
    m.center(h[kRadius], l[kRadius]);
    return m;
}

// The variance of the whole is the variance within rows plus that of the rows' means.
Moments along_column(const Taps& taps, const Moments* rows, size_t stride) {
    const Moments& middle = rows[kRadius * stride];
    Moments m, within;
    for (size_t i = 0; i < kTaps; ++i) {
        const Moments& row = rows[i * stride];
        m.add(taps[i], row.h - middle.h, row.l - middle.l);
        within.hh += taps[i] * row.hh;
        within.ll += taps[i] * row.ll;
        within.hl += taps[i] * row.hl;
    }
    m.center(middle.h, middle.l);
    m.hh += within.hh;
    m.ll += within.ll;
    m.hl += within.hl;
    return m;
}

// Structural fidelity of a window at a spatial frequency.
class Fidelity {
public:
    explicit Fidelity(double cycles) {
        // Mannos and Sakrison's contrast sensitivity, times 100.
        const double sensitivity =
            100 * 2.6 * (0.0192 + 0.114 * cycles) * std::exp(-std::pow(0.114 * cycles, 1.1));
        constexpr double middle_grey = 128, contrast = 1.4;
        m_threshold = middle_grey / (contrast * sensitivity);
        m_slope = 3 / (m_threshold * std::sqrt(2.0));
    }
    double operator()(const Moments& m) const {
        const double sh = std::sqrt(std::max(0.0, m.hh)), sl = std::sqrt(std::max(0.0, m.ll));
        const double vh = visible(sh), vl = visible(sl);
        return (2 * vh * vl + kC1) / (vh * vh + vl * vl + kC1) * (m.hl + kC2) / (sh * sl + kC2);
    }

private:
    // Whether a contrast is seen: the normal distribution around the threshold, sigma a third of
    // it.
    double visible(double deviation) const {
        return 0.5 * std::erfc((m_threshold - deviation) * m_slope);
    }
    double m_threshold, m_slope;
};

// Moments along some rows of a scale; rows outside the image are black, as are columns.
std::vector<Moments> row_moments(const Scale& scale, int first, int end) {
    const Taps& taps = gaussian();
    const auto width = size_t(scale.width);
    std::vector<Moments> out(size_t(end - first) * width);
    std::vector<double> h(width + 2 * kRadius), l(width + 2 * kRadius);
    for (int y = std::max(first, 0); y < std::min(end, scale.height); ++y) {
        scale.row(y, h.data() + kRadius, l.data() + kRadius);
        Moments* row = out.data() + size_t(y - first) * width;
        for (size_t x = 0; x < width; ++x)
            row[x] = along_row(taps, h.data() + x, l.data() + x);
    }
    return out;
}

// Calls use(y, structures) with every row.
template <class Use>
void structures(const Scale& scale, double cycles, const ParallelFor& parallel, const Use& use) {
    const Taps& taps = gaussian();
    const Fidelity fidelity(cycles);
    const auto width = size_t(scale.width);
    for_each_block(scale.width, scale.height, parallel, [&](int first, int end) {
        const auto moments = row_moments(scale, first - kRadius, end + kRadius);
        std::vector<double> row(width);
        for (int y = first; y < end; ++y) {
            const Moments* column = moments.data() + size_t(y - first) * width;
            for (size_t x = 0; x < width; ++x)
                row[x] = fidelity(along_column(taps, column + x, width));
            use(y, row);
        }
    });
}

double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (double v : values)
        sum += v;
    return sum;
}

// The pair as the paper's code sees it: HDR luminance in steps of 2^-32 of its range.
Scale finest(const TmqiPair& pair, const LightRange& range) {
    const double factor = 4294967295.0 / (range.high - range.low), low = range.low;
    return {pair.width, pair.height, [=](int y, double* hdr, double* ldr) {
                const int64_t at = int64_t(y) * pair.width;
                for (int x = 0; x < pair.width; ++x) {
                    const double h = double(pair.hdr[at + x]), l = double(pair.ldr[at + x]);
                    hdr[x] = std::isfinite(h) ? std::round(factor * (h - low)) : 0;
                    ldr[x] = std::isfinite(l) ? l : 0;
                }
            }};
}

// Means of 2x2 pixels; the last row and column are mirrored.
Scale halved(const Scale& from, std::vector<double> (&planes)[2], const ParallelFor& parallel) {
    const int width = (from.width + 1) / 2, height = (from.height + 1) / 2;
    std::vector<double> half[2];
    for (auto& plane : half)
        plane.resize(size_t(width) * size_t(height));
    for_each_block(width, height, parallel, [&](int first, int end) {
        const auto across = size_t(from.width);
        std::vector<double> upper[2], lower[2];
        for (size_t i = 0; i < 2; ++i) {
            upper[i].resize(across);
            lower[i].resize(across);
        }
        for (int y = first; y < end; ++y) {
            from.row(2 * y, upper[0].data(), upper[1].data());
            from.row(std::min(2 * y + 1, from.height - 1), lower[0].data(), lower[1].data());
            for (size_t i = 0; i < 2; ++i)
                for (size_t x = 0; x < size_t(width); ++x) {
                    const size_t a = 2 * x, b = std::min(2 * x + 1, across - 1);
                    half[i][size_t(y) * size_t(width) + x] =
                        (upper[i][a] + upper[i][b] + lower[i][a] + lower[i][b]) / 4;
                }
        }
    });
    planes[0].swap(half[0]);
    planes[1].swap(half[1]);
    return {width, height, [&planes, width](int y, double* hdr, double* ldr) {
                const auto at = ptrdiff_t(y) * width;
                std::copy_n(planes[0].begin() + at, width, hdr);
                std::copy_n(planes[1].begin() + at, width, ldr);
            }};
}

// Deviation (n - 1) of a block of 11x11 pixels; black beyond the picture, as the paper's code pads.
double block_deviation(const TmqiPair& pair, int x0, int y0) {
    std::array<double, size_t(kTaps) * kTaps> values{};
    for (int y = y0; y < std::min(y0 + kTaps, pair.height); ++y)
        for (int x = x0; x < std::min(x0 + kTaps, pair.width); ++x) {
            const float v = pair.ldr[int64_t(y) * pair.width + x];
            values[size_t((y - y0) * kTaps + x - x0)] = std::isfinite(v) ? double(v) : 0;
        }
    double sum = 0, squares = 0;
    for (double v : values)
        sum += v;
    const double mean = sum / double(values.size());
    for (double v : values)
        squares += (v - mean) * (v - mean);
    return std::sqrt(squares / double(values.size() - 1));
}

void measure_picture(const TmqiPair& pair, const ParallelFor& parallel, TmqiScore& score) {
    const int columns = (pair.width + kTaps - 1) / kTaps, rows = (pair.height + kTaps - 1) / kTaps;
    std::vector<double> sums(size_t(pair.height)), deviations(static_cast<size_t>(rows));
    parallel(rows, [&](int64_t row) {
        const int y0 = int(row) * kTaps;
        for (int column = 0; column < columns; ++column)
            deviations[size_t(row)] += block_deviation(pair, column * kTaps, y0);
        for (int y = y0; y < std::min(y0 + kTaps, pair.height); ++y)
            for (int x = 0; x < pair.width; ++x)
                if (const float v = pair.ldr[int64_t(y) * pair.width + x]; std::isfinite(v))
                    sums[size_t(y)] += double(v);
    });
    score.mean = sum_of(sums) / (double(pair.width) * pair.height);
    score.deviation = sum_of(deviations) / (double(columns) * rows);
}

// Each density over its largest value.
double naturalness(double mean, double deviation) {
    constexpr double mode = (kBetaA - 1) / (kBetaA + kBetaB - 2);
    const double offset = (mean - kMean) / kMeanSigma, contrast = deviation / kContrastRange;
    if (contrast <= 0 || contrast >= 1)
        return 0;
    return std::exp(-offset * offset / 2) * std::pow(contrast / mode, kBetaA - 1) *
           std::pow((1 - contrast) / (1 - mode), kBetaB - 1);
}

double fidelity_of(const Scale& scale, double cycles, const ParallelFor& parallel) {
    std::vector<double> sums(size_t(scale.height));
    structures(scale, cycles, parallel,
               [&](int y, const std::vector<double>& row) { sums[size_t(y)] = sum_of(row); });
    return sum_of(sums) / (double(scale.width) * scale.height);
}

double finest_fidelity(const TmqiPair& pair, const Scale& scale, float* map,
                       const ParallelFor& parallel) {
    std::vector<double> sums(size_t(scale.height));
    structures(scale, kFinestCycles, parallel, [&](int y, std::vector<double>& row) {
        const int64_t at = int64_t(y) * pair.width;
        for (int x = 0; x < pair.width; ++x) {
            double& structure = row[size_t(x)];
            if (std::isfinite(pair.hdr[at + x]) != std::isfinite(pair.ldr[at + x]))
                structure = 0;
            map[at + x] = float(structure);
        }
        sums[size_t(y)] = sum_of(row);
    });
    return sum_of(sums) / (double(scale.width) * scale.height);
}

} // namespace

LightRange light_range(const float* plane, int width, int height, const ParallelFor& parallel) {
    std::vector<std::array<float, 2>> rows(size_t(std::max(height, 0)), {INFINITY, -INFINITY});
    for_each_block(width, height, parallel, [&](int first, int end) {
        for (int y = first; y < end; ++y)
            for (int x = 0; x < width; ++x)
                if (const float v = plane[int64_t(y) * width + x]; std::isfinite(v)) {
                    auto& row = rows[size_t(y)];
                    row = {std::min(row[0], v), std::max(row[1], v)};
                }
    });
    float low = INFINITY, high = -INFINITY;
    for (const auto& row : rows) {
        low = std::min(low, row[0]);
        high = std::max(high, row[1]);
    }
    return low <= high ? LightRange{double(low), double(high)} : LightRange{};
}

size_t tmqi_work_bytes(int width, int height) {
    const int64_t rows = std::min<int64_t>(block_rows(width), height) + kTaps;
    return size_t(rows) * size_t(width) * sizeof(Moments);
}

TmqiScore tmqi(const TmqiPair& pair, const LightRange& range, float* structure,
               const ParallelFor& parallel) {
    TmqiScore score;
    std::vector<double> planes[2];
    Scale scale = finest(pair, range);
    score.scales[0] = finest_fidelity(pair, scale, structure, parallel);
    for (size_t i = 1; i < kScales; ++i) {
        scale = halved(scale, planes, parallel);
        score.scales[i] = fidelity_of(scale, kFinestCycles / double(1 << i), parallel);
    }
    score.s = 1;
    // A scale that shows the opposite of the HDR image has no real power: the product is 0.
    for (size_t i = 0; i < kScales; ++i)
        score.s *= std::pow(std::max(0.0, score.scales[i]), kWeight[i]);
    measure_picture(pair, parallel, score);
    score.n = naturalness(score.mean, score.deviation);
    score.q = tmqi_index(score.s, score.n);
    return score;
}

} // namespace tonetool::metrics
