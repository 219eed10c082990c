// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/detail_scan.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tonetool::metrics {
namespace {

constexpr int kShift = 16; // of the bits of a float: the sign, the exponent, 7 bits of the mantissa
constexpr size_t kSteps = 1 << 15;

float value_of(uint32_t code) {
    const uint32_t bits = code << kShift;
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

// The luminance of 2 x 2 pixels in stops.
float block_stops(const LightRow& upper, const LightRow& lower, size_t block) {
    const size_t x = 2 * block;
    const float sum = upper.light[x] + upper.light[x + 1] + lower.light[x] + lower.light[x + 1];
    return std::log2(std::max(sum / 4, LightRow::kDark));
}

// The rows of a block row, the middle one being 0.
struct BlockRow {
    const LightRow *upper, *lower;
    bool is_there() const { return upper && lower; }
    float at(size_t block) const { return block_stops(*upper, *lower, block); }
};

void scan_blocks(const BlockRow (&rows)[3], std::vector<StepHistogram::Code>& out) {
    const size_t blocks = rows[1].upper->light.size() / 2;
    std::vector<float> middle(blocks);
    for (size_t i = 0; i < blocks; ++i)
        middle[i] = rows[1].at(i);
    for (size_t i = 1; i + 1 < blocks; ++i) {
        const float around = (rows[0].at(i) + rows[2].at(i) + middle[i - 1] + middle[i + 1]) / 4;
        out.push_back(StepHistogram::code(std::abs(middle[i] - around)));
    }
}

} // namespace

StepHistogram::Code StepHistogram::code(float value) {
    uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return Code((bits & 0x7fffffffU) >> kShift);
}

void StepHistogram::add(const std::vector<Code>& codes) {
    m_counts.resize(kSteps);
    for (const Code code : codes)
        ++m_counts[code];
    m_all += int64_t(codes.size());
}

double StepHistogram::quantile(double share) const {
    if (m_all == 0)
        return 0;
    const double rank = share * double(m_all);
    double below = 0;
    size_t code = 0;
    for (; code + 1 < kSteps && below + double(m_counts[code]) < rank; ++code)
        below += double(m_counts[code]);
    if (code == 0)
        return 0;
    const double low = value_of(uint32_t(code)), high = value_of(uint32_t(code) + 1);
    const double within = m_counts[code] > 0 ? (rank - below) / double(m_counts[code]) : 0;
    return low + (high - low) * within;
}

LightRow light_row(std::vector<float> light) {
    LightRow row{std::move(light), {}};
    row.stops.reserve(row.light.size());
    for (float& value : row.light) {
        value = std::max(value, 0.0f);
        row.stops.push_back(std::log2(std::max(value, LightRow::kDark)));
    }
    return row;
}

DetailRow DetailScan::scan(const LightRow* const (&rows)[2 * kRadius + 1], int64_t y) {
    DetailRow out;
    const LightRow& here = *rows[kRadius];
    const LightRow *above = rows[kRadius - 1], *below = rows[kRadius + 1];
    const size_t width = here.light.size();
    for (size_t x = 0; x < width; ++x) {
        if (!(here.light[x] > LightRow::kDark))
            continue;
        const float stops = here.stops[x];
        if (x > 0)
            out.across.push_back(StepHistogram::code(std::abs(stops - here.stops[x - 1])));
        if (above)
            out.down.push_back(StepHistogram::code(std::abs(stops - above->stops[x])));
        if (above && below && x > 0 && x + 1 < width) {
            const float around =
                (above->stops[x] + below->stops[x] + here.stops[x - 1] + here.stops[x + 1]) / 4;
            out.fine.push_back(StepHistogram::code(std::abs(stops - around)));
        }
    }
    const BlockRow blocks[3] = {{rows[kRadius - 2], rows[kRadius - 1]},
                                {rows[kRadius], rows[kRadius + 1]},
                                {rows[kRadius + 2], rows[kRadius + 3]}};
    if (y % 2 == 0 && blocks[0].is_there() && blocks[1].is_there() && blocks[2].is_there())
        scan_blocks(blocks, out.coarse);
    return out;
}

void DetailScan::add(const DetailRow& row) {
    m_fine.add(row.fine);
    m_coarse.add(row.coarse);
    m_across.add(row.across);
    m_down.add(row.down);
}

} // namespace tonetool::metrics
