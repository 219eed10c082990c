// SPDX-License-Identifier: BSD-3-Clause
// Which pixels of an image show the scene, so that statistics are of it and not of what is around.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <string>
#include <vector>

#include "imagebuf/pixels/paged_array.h"
#include "kernels/views.h"
#include "metrics/order_statistics.h"

namespace tonetool {

/// The luminances of the pixels that show something, packed: NaN for those that do not, and for
/// black ones what tonemap/cell_mean.h says.
struct CountedPixels {
    PagedArray<float> luminance;
    int64_t lit = 0;         ///< pixels with light
    int64_t nothing = 0;     ///< pixels that show nothing, or perhaps nothing
    bool alpha_tells = true; ///< false where it is 0 at all light there is, and so was not used
};

/// What tells whether a pixel shows something; null: nothing does.
struct ShownPixels {
    const float* alpha = nullptr;
    const uint8_t* background = nullptr;
};

/// Out are pixels that are not finite, those of alpha 0, and black ones on the background. Where
/// neither alpha nor a guide tells, black pixels count in cells that are lit, and nowhere else. An
/// alpha that would leave no light at all says nothing.
CountedPixels counted_pixels(const float* luminance, int width, int height,
                             const ShownPixels& shown, const kernels::ParallelFor& parallel);

/// What stands for the largest of so many luminances: all that are above the percentile are passed
/// over, at least one.
metrics::Wanted maximum_of_lit(double percentile, int64_t counted);

/// 1 where an image shows no surface, by its depth and position; empty where it has neither.
/// `layer` is that of the picture.
std::vector<uint8_t> background_of(const OIIO::ImageBuf& image, const std::string& layer,
                                   OIIO::ROI region, int nthreads);

} // namespace tonetool
