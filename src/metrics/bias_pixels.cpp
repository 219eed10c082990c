// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/bias_pixels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/curve.h"

namespace tonetool::metrics::bias {
namespace {

constexpr int kChunk = 256;

struct Chunk {
    double values[6][kChunk];
    double* r[3] = {values[0], values[1], values[2]};
    double* t[3] = {values[3], values[4], values[5]};
};

// Sums of finite floats are finite doubles: only other values make this one so.
bool all_finite(const double* a, const double* b, int count) {
    double sum[4] = {};
    int x = 0;
    for (; x + 3 < count; x += 4)
        for (int i = 0; i < 4; ++i)
            sum[i] += a[x + i] + b[x + i];
    for (; x < count; ++x)
        sum[0] += a[x] + b[x];
    return std::isfinite((sum[0] + sum[1]) + (sum[2] + sum[3]));
}

} // namespace

void luminance_row(const double* const rgb[3], int count, double* out) {
    using kernels::kLuminance;
    for (int x = 0; x < count; ++x)
        out[x] = kLuminance[0] * rgb[0][x] + kLuminance[1] * rgb[1][x] + kLuminance[2] * rgb[2][x];
}

Pixels::Pixels(const BiasSide& reference, const BiasSide& test, const uint8_t* ignored)
    : m_reference(reference),
      m_test(test),
      m_ignored(ignored),
      m_bad(size_t(std::max(reference.height(), 0))) {}

// A pixel's luminance is finite where all of its channels are.
void Pixels::luminance(int y, double* r, double* t) {
    Chunk chunk;
    for (int x = 0; x < width(); x += kChunk) {
        const int count = std::min(kChunk, width() - x);
        for (int c = 0; c < 3; ++c) {
            m_reference.row(c, y, x, count, chunk.r[c]);
            m_test.row(c, y, x, count, chunk.t[c]);
        }
        luminance_row(chunk.r, count, r + x);
        luminance_row(chunk.t, count, t + x);
    }
    if (all_finite(r, t, width()))
        return;
    int bad = 0;
    for (int x = 0; x < width(); ++x)
        if (!std::isfinite(r[x]) || !std::isfinite(t[x])) {
            r[x] = t[x] = 0;
            ++bad;
        }
    m_bad[size_t(y)] = bad;
}

int64_t Pixels::counted() const {
    const int64_t all = int64_t(width()) * height();
    return m_ignored ? std::count(m_ignored, m_ignored + all, 0) : all;
}

int64_t Pixels::nonfinite() const {
    return std::accumulate(m_bad.begin(), m_bad.end(), int64_t(0));
}

void Pixels::row(int y, int x, int count, double* const r[3], double* const t[3]) const {
    for (int c = 0; c < 3; ++c) {
        m_reference.row(c, y, x, count, r[c]);
        m_test.row(c, y, x, count, t[c]);
    }
    if (m_bad[size_t(y)] == 0)
        return;
    for (int i = 0; i < count; ++i)
        if (!std::isfinite(r[0][i] + r[1][i] + r[2][i] + t[0][i] + t[1][i] + t[2][i]))
            for (int c = 0; c < 3; ++c)
                r[c][i] = t[c][i] = 0;
}

void Pixels::strip(const kernels::Window& window, Strip& out) const {
    out.window = window;
    out.ignored = m_ignored ? ignored(window.y0) + window.x0 : nullptr;
    out.ignored_step = width();
    double t[kBiasChannels][Strip::kWidth];
    double* const test[3] = {t[1], t[2], t[3]};
    for (int y = 0; y < window.height; ++y) {
        const ptrdiff_t at = ptrdiff_t(y) * Strip::kWidth;
        double* const r[3] = {out.r[1] + at, out.r[2] + at, out.r[3] + at};
        row(window.y0 + y, window.x0, window.width, r, test);
        luminance_row(r, window.width, out.r[0] + at);
        luminance_row(test, window.width, t[0]);
        for (int c = 0; c < kBiasChannels; ++c)
            for (int x = 0; x < window.width; ++x)
                out.d[c][at + x] = t[c][x] - out.r[c][at + x];
    }
}

void Pixels::half_products(int y, double* out) const {
    const auto columns = size_t(width());
    std::vector<double> r(columns), t(columns), d(columns);
    m_reference.half_row(0, y, r.data());
    m_test.half_row(0, y, t.data());
    for (size_t x = 0; x < columns; ++x)
        d[x] = t[x] - r[x];
    m_reference.half_row(1, y, r.data());
    m_test.half_row(1, y, t.data());
    for (size_t x = 0; x < columns; ++x) {
        out[x] = d[x] * (t[x] - r[x]);
        if (m_bad[size_t(y)] && !std::isfinite(out[x]))
            out[x] = 0;
    }
}

} // namespace tonetool::metrics::bias
