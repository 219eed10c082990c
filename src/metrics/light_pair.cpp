// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/light_pair.h"

#include <algorithm>
#include <cmath>

namespace tonetool::metrics {
namespace {

constexpr size_t kSums = 4;

// A side of blocks: one block of what there is where that is less than a block.
size_t blocks_in(int64_t size) {
    return size_t(std::max<int64_t>(size / LightPair::kSide, size > 0 ? 1 : 0));
}

bool is_finite(const float* pixel, size_t channels) {
    return std::all_of(pixel, pixel + channels, [](float v) { return std::isfinite(v); });
}

// A row without the pixels that are not finite in it or in the other.
std::vector<float> cleaned(const std::vector<float>& row, const std::vector<float>& other,
                           size_t channels) {
    std::vector<float> clean(row);
    for (size_t at = 0; at < row.size(); at += channels)
        if (!is_finite(&row[at], channels) || !is_finite(&other[at], channels))
            std::fill_n(clean.begin() + std::ptrdiff_t(at), channels, 0.0f);
    return clean;
}

} // namespace

LightPair::LightPair(int64_t width, int64_t height, size_t channels)
    : m_width(width),
      m_height(height),
      m_channels(channels),
      m_columns(blocks_in(width)),
      m_rows(blocks_in(height)),
      m_sums(kSums * channels * m_columns * m_rows) {}

LightPair::Row LightPair::scan(const std::vector<float>& a, const std::vector<float>& b) const {
    const std::vector<float> clean_a = cleaned(a, b, m_channels);
    const std::vector<float> clean_b = cleaned(b, a, m_channels);
    Row row;
    for (size_t at = 0; at < a.size(); at += m_channels) {
        const bool of_a = is_finite(&a[at], m_channels), of_b = is_finite(&b[at], m_channels);
        if (of_a != of_b && row.one_finite++ == 0)
            row.first = int64_t(at / m_channels);
        row.both_finite += of_a && of_b;
    }
    row.sums.resize(kSums * m_channels * m_columns);
    for (int64_t x = 0; x < m_width; ++x) {
        const size_t at = size_t(x) * m_channels, column = size_t(x / kSide);
        // The last column has the difference of the one before it.
        const size_t left =
            size_t(std::clamp<int64_t>(x, 0, std::max<int64_t>(m_width - 2, 0))) * m_channels;
        const size_t right = m_width > 1 ? left + m_channels : left;
        for (size_t c = 0; c < m_channels; ++c) {
            const double va = clean_a[at + c], vb = clean_b[at + c];
            row.a += std::abs(va);
            row.b += std::abs(vb);
            if (column >= m_columns)
                continue;
            const double da = double(clean_a[right + c]) - double(clean_a[left + c]);
            const double db = double(clean_b[right + c]) - double(clean_b[left + c]);
            double* sums = &row.sums[kSums * (column * m_channels + c)];
            sums[0] += va;
            sums[1] += vb;
            sums[2] += da * da / 2;
            sums[3] += db * db / 2;
        }
    }
    return row;
}

void LightPair::add(int64_t y, const Row& row) {
    m_a += row.a;
    m_b += row.b;
    if (m_one_finite == 0 && row.one_finite > 0) {
        m_first_x = row.first;
        m_first_y = y;
    }
    m_one_finite += row.one_finite;
    m_both_finite += row.both_finite;
    const auto block_row = size_t(y / kSide);
    if (block_row >= m_rows)
        return;
    for (size_t i = 0; i < row.sums.size(); ++i)
        m_sums[block_row * row.sums.size() + i] += row.sums[i];
}

LightPair::Block LightPair::block(size_t at, size_t channel) const {
    const double* sums = &m_sums[kSums * (at * m_channels + channel)];
    const double pixels = double(std::min(m_width, kSide) * std::min(m_height, kSide));
    return {sums[0] / pixels, sums[1] / pixels,
            std::sqrt((sums[2] + sums[3]) / pixels) / std::sqrt(pixels)};
}

double LightPair::mean_of_a() const {
    double sum = 0;
    for (size_t i = 0; i < m_sums.size(); i += kSums)
        sum += block(i / kSums / m_channels, i / kSums % m_channels).a;
    return m_sums.empty() ? 0 : sum / (double(m_sums.size()) / kSums);
}

// Skewed noise moves the median of the blocks, a few lamps move the sum; an exposure moves both.
double LightPair::gain(double mean_a) const {
    constexpr double lit = 0.02, tiny = 1e-3;
    const double channels = double(m_channels);
    std::vector<std::pair<double, double>> means;
    double all = 0;
    for (size_t at = 0; at < m_columns * m_rows; ++at) {
        std::pair<double, double> mean;
        for (size_t c = 0; c < m_channels; ++c) {
            const Block one = block(at, c);
            mean.first += one.a / channels;
            mean.second += one.b / channels;
        }
        means.push_back(mean);
        all += mean.first + mean.second;
    }
    std::vector<double> stops;
    const double floor = tiny * mean_a + 1e-7;
    for (const auto& [a, b] : means)
        if (a + b > lit * all / double(means.size()))
            stops.push_back(std::log2((std::max(b, 0.0) + floor) / (std::max(a, 0.0) + floor)));
    if (stops.empty())
        return 0;
    const auto middle = stops.begin() + std::ptrdiff_t(stops.size() / 2);
    std::nth_element(stops.begin(), middle, stops.end());
    const double values = 1e-6 * double(m_width) * double(m_height) * channels;
    const double sum = std::log2((m_b + values) / (m_a + values));
    if (*middle * sum <= 0)
        return 0;
    return std::abs(*middle) < std::abs(sum) ? *middle : sum;
}

LightPair::Result LightPair::result() const {
    constexpr double errors = 6, share = 0.05, dark = 0.02;
    Result result;
    result.none_finite = m_width > 0 && m_height > 0 && m_both_finite == 0;
    if (m_sums.empty())
        return result;
    result.one_finite_x = m_first_x;
    result.one_finite_y = m_first_y;
    result.one_finite = double(m_one_finite) / std::max(double(m_width) * double(m_height), 1.0);
    const double mean = mean_of_a();
    size_t off = 0;
    double most = 0;
    for (size_t at = 0; at < m_columns * m_rows; ++at) {
        double worst = 0;
        for (size_t c = 0; c < m_channels; ++c) {
            const Block one = block(at, c);
            const double limit =
                std::max(errors * one.error,
                         share * std::max(one.a, one.b) + dark * std::max(mean, 0.0) + 1e-6);
            worst = std::max(worst, std::abs(one.a - one.b) / limit);
        }
        off += worst > 1;
        if (worst > most) {
            most = worst;
            result.x = int64_t(at % m_columns) * kSide;
            result.y = int64_t(at / m_columns) * kSide;
        }
    }
    result.blocks = double(off) / double(m_columns * m_rows);
    result.gain = gain(mean);
    return result;
}

} // namespace tonetool::metrics
