// SPDX-License-Identifier: BSD-3-Clause
// The colour of an ImageBuf as planes the algorithms can run on.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <string>
#include <vector>

#include "imagebuf/pixels/paged_array.h"
#include "kernels/views.h"
#include "metrics/refusal.h"
#include "tonetool/pixels.h"

namespace tonetool {

class IgnoredPixels;

/// What was found in the pixels read so far, each of them looked at once.
struct ColorCounts {
    int64_t nonfinite = 0, negative = 0;
    float largest = 0; ///< largest component
    /// Depends on the values of the negative pixels as they were before they became 0.
    uint64_t negative_digest = 0;
    /// Depends on the alpha of the pixels that are not opaque, where alpha is watched.
    uint64_t alpha_digest = 0;

    void add(const ColorCounts& other);
};

/// Finite linear Rec.709 >= 0 over a band of the rows of a region, or over all of them, and what
/// had to be done to get there.
struct ColorPlanes {
    OIIO::ROI region;       ///< the whole
    int begin = 0, end = 0; ///< rows that are held
    ColorChoice choice;
    PagedArray<float> plane[3];
    PagedArray<float> alpha; ///< empty unless asked for
    /// Which of R, G, B (and the alpha asked for) is what: two bits each, 0 for a finite number, 1
    /// for Inf, 2 for -Inf, 3 for NaN.
    PagedArray<uint8_t> nonfinite;
    /// Where that is not 0: the finite ones of R, G, B as they were stored. Not initialized
    /// elsewhere, so that it takes no memory.
    PagedArray<uint64_t> beside;
    bool knows_kinds = true; ///< resizing leaves NaN of everything that is not finite
    ColorCounts counts;
    /// Which pixels do not count: they are in no count, and finite. Null where all count.
    const IgnoredPixels* ignored = nullptr;
    int64_t counted = 0;         ///< pixels of the region that count,
    int64_t uncovered_count = 0; ///< and those of them outside the data window

    int width() const { return region.width(); }
    bool whole() const { return begin == region.ybegin && end == region.yend; }
    /// Where a row begins in the planes.
    size_t at(int y) const { return size_t(y - begin) * size_t(width()); }
    kernels::ConstRgb view() const;
    /// Row `y` of the planes from column `x` on, as the kernels take it.
    void row(int x, int y, const float* (&out)[3]) const;
};

/// How errors begin: `side image "name": `, or without the name where there is none.
std::string side_name(const char* side, const OIIO::ImageBuf& image);

/// What a reader said, after the name of the side; that of the file is said once.
std::string with_side(const std::string& side_name, const std::string& why);

/// What `run` returns; a Refusal says which image it is about.
template <class Run>
auto of_side(const std::string& side_name, const Run& run) {
    return refusing_as([&](const std::string& why) { return with_side(side_name, why); }, run);
}

/// Refuses an image that cannot be looked at at all: not read without error, deep, or a volume.
void check_readable(const OIIO::ImageBuf& image, const char* what);

/// The channels of a colour, each once: one for a grey picture.
std::vector<int> channels_of(const ColorChoice& choice);

/// The header `find_color` decides by: the image's spec with the data format of its file, which
/// tells display-encoded integers from linear floats, and the whole EXPOSURE of a Radiance file.
/// Integers of light that alpha is in count as the floats that they encode.
OIIO::ImageSpec deciding_spec(const OIIO::ImageBuf& image);

} // namespace tonetool
