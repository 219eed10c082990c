// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/bands.h"

#include <OpenImageIO/sysutil.h>
#include <algorithm>

#include "metrics/refusal.h"

namespace tonetool {
namespace {

// The smallest band: below it most of the work is done for the rows around it.
constexpr int kLeastRows = 16;
// Bands of more rows are multiples of it, so that whole tiles fit in.
constexpr int kGoodRows = 96;
// Fewer threads than these are not worth the memory that they would save.
constexpr int kLeastThreads = 2;

} // namespace

std::string size_text(uint64_t bytes) {
    constexpr uint64_t mega = uint64_t(1) << 20;
    return std::to_string((bytes + mega - 1) / mega) + "M";
}

uint64_t Bands::maps_until(int row) const {
    return m_needs.map_row * uint64_t(std::clamp(row, m_roi.ybegin, m_roi.yend) - m_roi.ybegin);
}

void Bands::plan(uint64_t memory, const MemoryNeeds& needs, const OIIO::ROI& region,
                 const OIIO::ROI& roi) {
    m_needs = needs;
    m_region = region;
    m_roi = roi;
    m_budget = memory > 0 ? memory : OIIO::Sysutil::physical_memory() / 2;
    const auto rows = uint64_t(region.height());
    const auto fixed_for = [&](int threads) {
        return kSetAside + needs.held + needs.thread * uint64_t(threads);
    };
    // In one piece the luminances of the reference are held before the maps are.
    const uint64_t maps = maps_until(roi.yend);
    const uint64_t second = std::max(maps, needs.measuring);
    m_one = needs.band_rows == 0 &&
            fixed_for(needs.threads) + needs.reading + needs.row * rows + second <= m_budget;
    const uint64_t band =
        needs.reading + needs.row * std::min(rows, uint64_t(kLeastRows + 2 * needs.radius));
    const int few = std::min(kLeastThreads, needs.threads);
    const uint64_t least = fixed_for(few) + std::max(maps + band, needs.measuring);
    // Half of what is left for more threads, the other half for larger bands.
    const uint64_t left = m_budget > least ? m_budget - least : 0;
    const uint64_t more = left / 2 / std::max<uint64_t>(needs.thread, 1);
    m_threads = few + int(std::min(uint64_t(needs.threads - few), more));
    m_threads = m_one ? needs.threads : m_threads;
    m_fixed = fixed_for(m_threads);
    if (memory > 0 && least > m_budget)
        throw Refusal("memory is " + size_text(memory) + ": this comparison needs at least " +
                      size_text(least) + " (" + size_text(maps + needs.held) +
                      " for its maps and " + size_text(kSetAside) +
                      " for the program and its libraries)");
}

int Bands::end_of(int begin) const {
    if (m_one)
        return m_region.yend;
    if (m_needs.band_rows > 0)
        return std::min(begin + m_needs.band_rows, m_region.yend);
    const uint64_t around = m_needs.row * uint64_t(2 * m_needs.radius);
    const uint64_t taken = m_fixed + m_needs.reading + around + maps_until(begin);
    const uint64_t left = m_budget > taken ? m_budget - taken : 0;
    uint64_t rows = std::max<uint64_t>(left / (m_needs.row + m_needs.map_row), kLeastRows);
    rows = rows > kGoodRows ? rows / kGoodRows * kGoodRows : rows;
    return int(std::min<int64_t>(int64_t(begin) + int64_t(std::min<uint64_t>(rows, 1 << 30)),
                                 m_region.yend));
}

} // namespace tonetool
