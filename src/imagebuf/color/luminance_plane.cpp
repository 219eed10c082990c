// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/luminance_plane.h"

#include <algorithm>
#include <limits>

#include "imagebuf/pixels/ignored_pixels.h"
#include "imagebuf/pixels/parallel.h"

namespace tonetool {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// One row: NaN where there is nothing to measure.
void row_of_luminance(const ColorPlanes& planes, const OIIO::ROI& window, int y,
                      LuminanceRow luminances, float* out) {
    const int width = planes.width();
    const float* rgb[3];
    planes.row(planes.region.xbegin, y, rgb);
    luminances(rgb[0], rgb[1], rgb[2], out, width);
    const uint8_t* nonfinite = planes.nonfinite.data() + planes.at(y);
    const uint8_t* ignored = planes.ignored ? planes.ignored->row(y) : nullptr;
    const bool inside = y >= window.ybegin && y < window.yend;
    for (int i = 0; i < width; ++i) {
        const int x = planes.region.xbegin + i;
        if (nonfinite[i] || !inside || x < window.xbegin || x >= window.xend ||
            (ignored && ignored[i] != 0))
            out[i] = kNan;
    }
}

} // namespace

size_t luminance_bytes(const OIIO::ROI& region) {
    return size_t(region.width()) * size_t(region.height()) * sizeof(float);
}

PagedArray<float> read_luminance(ColorReader& reader, ColorPlanes& planes, int nthreads,
                                 LuminanceRow luminances) {
    PagedArray<float> plane;
    const OIIO::ROI& region = planes.region;
    const auto parallel = make_parallel(nthreads);
    plane.resize(luminance_bytes(region) / sizeof(float));
    plane.expect_all_written();
    const auto measure = [&](int begin, int end) {
        parallel(end - begin, [&](int64_t row) {
            const int y = begin + int(row);
            row_of_luminance(planes, reader.window(), y, luminances,
                             plane.data() + size_t(y - region.ybegin) * size_t(region.width()));
        });
    };
    if (planes.whole()) {
        measure(region.ybegin, region.yend);
    } else {
        for (int y = region.ybegin; y < region.yend; y += kLuminanceRows) {
            const int end = std::min(y + kLuminanceRows, region.yend);
            reader.read(y, end, planes);
            measure(y, end);
        }
        ColorPlanes empty = reader.planes();
        empty.counts = planes.counts;
        planes = std::move(empty);
    }
    return plane;
}

} // namespace tonetool
