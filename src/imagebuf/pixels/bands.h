// SPDX-License-Identifier: BSD-3-Clause
// How much of a comparison is in memory at once.
#pragma once

#include <OpenImageIO/imageio.h>
#include <cstdint>
#include <string>

namespace tonetool {

/// Counted against the bound before anything of a comparison is: the program, the shared libraries
/// of OpenImageIO and what their allocators keep.
inline constexpr uint64_t kSetAside = uint64_t(105) << 20;

/// What a comparison holds, in bytes.
struct MemoryNeeds {
    uint64_t row = 0;       ///< a row of all images as planes
    uint64_t map_row = 0;   ///< a row of all maps; a map takes memory as it is filled
    uint64_t held = 0;      ///< all the time
    uint64_t reading = 0;   ///< while a band is read
    uint64_t measuring = 0; ///< of the pass that measures the reference, in all
    uint64_t thread = 0;    ///< work space of a thread that evaluates
    int threads = 1;        ///< as many as there may be
    int radius = 0;         ///< rows around a band that its errors depend on
    int band_rows = 0;      ///< if not 0, bands are of so many rows, whatever the memory
};

/// "268435456" as "256M"; rounded up.
std::string size_text(uint64_t bytes);

/// Cuts a region into bands of rows.
class Bands {
public:
    /// `memory`: the bound, 0 for half of this computer's memory, which is not enforced where even
    /// the smallest bands take more. A Refusal where a bound is too small.
    void plan(uint64_t memory, const MemoryNeeds& needs, const OIIO::ROI& region,
              const OIIO::ROI& roi);
    /// Whether everything is in memory at once.
    bool one() const { return m_one; }
    /// Threads that may evaluate at the same time.
    int threads() const { return m_threads; }
    /// Where the band that begins with a row ends.
    int end_of(int begin) const;

private:
    uint64_t maps_until(int row) const;

    MemoryNeeds m_needs;
    OIIO::ROI m_region, m_roi;
    uint64_t m_budget = 0, m_fixed = 0;
    int m_threads = 1;
    bool m_one = true;
};

} // namespace tonetool
