// SPDX-License-Identifier: BSD-3-Clause
// The pixels of a comparison that do not count: what IgnoreOptions says, as one byte for each.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <string>
#include <vector>

#include "tonetool/compare.h"

namespace tonetool {

class IgnoredPixels {
public:
    /// Of a region of the reference with this header. Throws a Refusal for what IgnoreOptions calls
    /// an error.
    void open(const IgnoreOptions& options, const OIIO::ImageSpec& reference,
              const OIIO::ROI& region);

    /// A mask or a region was given, even if all pixels count.
    bool asked() const { return m_asked; }
    /// Some pixel of the region does not count.
    bool any() const { return !m_ignored.empty(); }
    /// From the region's first column on, 1 where a pixel does not count; only if any().
    const uint8_t* row(int y) const {
        return m_ignored.data() + size_t(y - m_region.ybegin) * size_t(m_region.width());
    }
    bool at(int x, int y) const { return row(y)[x - m_region.xbegin] != 0; }
    /// All of the region's; only if any().
    const std::vector<uint8_t>& all() const { return m_ignored; }
    /// How many pixels of a part of the region do not count,
    int64_t count(const OIIO::ROI& part) const;
    /// and how many do; a Refusal if none does.
    int64_t counted(const OIIO::ROI& part) const;
    /// The part of a part's pixels that does not count; unset if nothing was asked.
    std::optional<double> share(const OIIO::ROI& part) const;
    uint64_t bytes() const { return m_ignored.size(); }

private:
    void mark_mask(const Mask& mask, const OIIO::ImageSpec& reference);
    void mark_by(const OIIO::ImageBuf& mask, const OIIO::ImageSpec& reference);
    void mark_region(const std::string& text);
    uint8_t* writable(int y) { return const_cast<uint8_t*>(row(y)); }

    bool m_asked = false;
    OIIO::ROI m_region;
    std::vector<uint8_t> m_ignored;
};

/// Says so where more than half of the compared pixels do not count.
void warn_of_ignored(const std::optional<double>& share, std::vector<std::string>& warnings);

/// A mask that says the same of a region whose display window it is.
Mask mask_of(const IgnoredPixels& ignored, const OIIO::ROI& region);

} // namespace tonetool
