// SPDX-License-Identifier: BSD-3-Clause
// Convolution by Fourier transforms in double precision: an image of lights of 1e5 beside pixels of
// 1e-3 has no error that can be seen.
#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "tonemap/bloom.h"

namespace tonetool::tonemap {
namespace {

using Complex = std::complex<double>;
using Fourier = Eigen::FFT<double>;

constexpr int kBatch = 32;   // rows of a task, which share the tables of a transform
constexpr int kTogether = 8; // columns that are read at once

// The next size whose factors are 2, 3 and 5, and a multiple of 4, as transforms of real numbers
// want it.
int good_size(int least) {
    for (int n = (least + 3) / 4 * 4;; n += 4) {
        int rest = n;
        for (int factor : {2, 3, 5})
            while (rest % factor == 0)
                rest /= factor;
        if (rest == 1)
            return n;
    }
}

// Frequencies of the rows, half of them, as those of real numbers are.
class Frequencies {
public:
    Frequencies(int columns, int rows)
        : m_columns(columns),
          m_rows(rows),
          m_half(columns / 2 + 1),
          m_values(size_t(m_half) * size_t(rows)) {}

    int half() const { return m_half; }
    Complex* row(int y) { return m_values.data() + size_t(y) * size_t(m_half); }

    // visit(y, row, transform, frequencies) for rows 0 to `count` - 1; row has room for `columns`.
    template <class Visit>
    void rows(int count, const kernels::ParallelFor& parallel, const Visit& visit) {
        parallel((count + kBatch - 1) / kBatch, [&](int64_t batch) {
            Fourier fourier;
            fourier.SetFlag(Fourier::HalfSpectrum);
            std::vector<double> values(static_cast<size_t>(m_columns));
            const int end = std::min(count, int(batch + 1) * kBatch);
            for (int y = int(batch) * kBatch; y < end; ++y)
                visit(y, values, fourier, row(y));
        });
    }

    // visit(x, column, transform) for all columns; `column` holds m_rows values and is put back.
    template <class Visit>
    void columns(const kernels::ParallelFor& parallel, const Visit& visit) {
        parallel((m_half + kBatch - 1) / kBatch, [&](int64_t batch) {
            Fourier fourier;
            std::vector<Complex> kept[kTogether];
            for (auto& column : kept)
                column.resize(size_t(m_rows));
            const int end = std::min(m_half, int(batch + 1) * kBatch);
            for (int begin = int(batch) * kBatch; begin < end; begin += kTogether) {
                const int count = std::min(kTogether, end - begin);
                for (int y = 0; y < m_rows; ++y)
                    for (int i = 0; i < count; ++i)
                        kept[i][size_t(y)] = row(y)[begin + i];
                for (int i = 0; i < count; ++i)
                    visit(begin + i, kept[i], fourier);
                for (int y = 0; y < m_rows; ++y)
                    for (int i = 0; i < count; ++i)
                        row(y)[begin + i] = kept[i][size_t(y)];
            }
        });
    }

private:
    int m_columns, m_rows, m_half;
    std::vector<Complex> m_values;
};

} // namespace

Spreading::Spreading(const PointSpread& spread, int width, int height,
                     const kernels::ParallelFor& parallel)
    : m_width(width),
      m_height(height),
      m_columns(good_size(width + spread.width - 1)),
      m_rows(good_size(height + spread.height - 1)) {
    Frequencies all(m_columns, m_rows);
    all.rows(spread.height, parallel, [&](int y, auto& values, Fourier& fourier, Complex* row) {
        std::fill(values.begin(), values.end(), 0.0);
        for (int x = 0; x < spread.width; ++x)
            values[size_t(x)] = values[size_t((m_columns - x) % m_columns)] = spread.at(x, y);
        fourier.fwd(row, values.data(), m_columns);
        if (y > 0)
            std::copy(row, row + all.half(), all.row(m_rows - y));
    });
    m_gains.resize(size_t(all.half()) * size_t(m_rows));
    all.columns(parallel, [&](int x, std::vector<Complex>& column, Fourier& fourier) {
        std::vector<Complex> found(column.size());
        fourier.fwd(found.data(), column.data(), m_rows);
        for (size_t y = 0; y < found.size(); ++y)
            m_gains[size_t(x) * size_t(m_rows) + y] = found[y].real();
    });
}

void Spreading::apply(float* plane, const kernels::ParallelFor& parallel) const {
    Frequencies all(m_columns, m_rows);
    all.rows(m_height, parallel, [&](int y, auto& values, Fourier& fourier, Complex* row) {
        const float* from = plane + ptrdiff_t(y) * m_width;
        std::copy(from, from + m_width, values.begin());
        std::fill(values.begin() + m_width, values.end(), 0.0);
        fourier.fwd(row, values.data(), m_columns);
    });
    all.columns(parallel, [&](int x, std::vector<Complex>& column, Fourier& fourier) {
        std::vector<Complex> found(column.size());
        fourier.fwd(found.data(), column.data(), m_rows);
        for (size_t y = 0; y < found.size(); ++y)
            found[y] *= m_gains[size_t(x) * size_t(m_rows) + y];
        fourier.inv(column.data(), found.data(), m_rows);
    });
    all.rows(m_height, parallel, [&](int y, auto& values, Fourier& fourier, Complex* row) {
        fourier.inv(values.data(), row, m_columns);
        float* to = plane + ptrdiff_t(y) * m_width;
        for (int x = 0; x < m_width; ++x)
            to[x] = float(std::max(values[size_t(x)], 0.0));
    });
}

} // namespace tonetool::tonemap
