// The colour of an ImageBuf as planes the algorithms can run on.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <string>
#include <vector>

#include "include/tonetool/pixels.h"
#include "kernels/views.h"

namespace tonetool {

/// Finite linear Rec.709 >= 0 over a region, and what had to be done to get there.
struct ColorPlanes {
    OIIO::ROI region;
    ColorChoice choice;
    std::vector<float> plane[3];
    std::vector<float> alpha;       ///< empty unless asked for
    std::vector<uint8_t> nonfinite; ///< 1 where R, G, B (or the alpha asked for) is NaN or Inf
    int64_t nonfinite_count = 0, negative_count = 0, uncovered_count = 0;
    float largest = 0; ///< largest component
    /// Depends on the values of the negative pixels as they were before they became 0.
    uint64_t negative_digest = 0;

    int width() const { return region.width(); }
    int height() const { return region.height(); }
    kernels::ConstRgb view() const;
};

/// How errors begin: `side image "name": `, or without the name where there is none.
std::string side_name(const char* side, const OIIO::ImageBuf& image);

/// Whether an image can be looked at at all: read without error, not deep, not a volume.
bool check_readable(const OIIO::ImageBuf& image, const char* what, std::string& error);

/// The header `find_color` decides by: the image's spec with the data format of its file, which
/// tells display-encoded integers from linear floats.
OIIO::ImageSpec deciding_spec(const OIIO::ImageBuf& image);

/// Reads `region` of an image; pixels outside its data window are black (alpha 0). Non-finite
/// pixels become black and are marked, negative components become 0 and are counted.
bool read_planes(const OIIO::ImageBuf& image, const PixelOptions& options, OIIO::ROI region,
                 bool want_alpha, int nthreads, ColorPlanes& out, std::string& error);

} // namespace tonetool
