// SPDX-License-Identifier: BSD-3-Clause
// Two images as --diff and --pdiff compare them where mask= or ignore= leave pixels out.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <string>
#include <vector>

#include "tonetool/compare.h"

namespace tonetool::chain {

/// How the pixels that do not count are left out.
enum class LeaveOut {
    Closing,   ///< those that count are closed up into one row, so that sums are theirs alone
    Equalizing ///< in place: both images get the values of the first, where they are finite
};

/// Throws a CommandError where the options are wrong, or the images are deep, of different windows
/// or channels.
class CountedPair {
public:
    CountedPair(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b, const IgnoreOptions& options,
                LeaveOut how);

    const OIIO::ImageBuf& a() const { return m_images[0]; }
    const OIIO::ImageBuf& b() const { return m_images[1]; }
    double pixels() const { return double(m_counted); } ///< that count
    double ignored() const { return m_ignored; }        ///< the part that does not
    const std::vector<std::string>& warnings() const { return m_warnings; }
    /// From a place in these images to the one in the images that came.
    void place(int& x, int& y) const;

private:
    void close(const OIIO::ImageBuf& from, OIIO::ImageBuf& to) const;
    void equalize();

    OIIO::ROI m_region;
    LeaveOut m_how;
    std::vector<uint8_t> m_marks; ///< 1 for a pixel that does not count
    int64_t m_counted = 0;
    double m_ignored = 0;
    std::vector<std::string> m_warnings;
    OIIO::ImageBuf m_images[2];
};

} // namespace tonetool::chain
