// SPDX-License-Identifier: BSD-3-Clause
// The images of one frame in the report.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "sequence/results/results.h"
#include "tonetool/flip.h"

namespace tonetool::sequence {

/// The images to draw. All pointers but `test` may be null.
struct PictureRequest {
    const OIIO::ImageBuf* reference = nullptr;
    const OIIO::ImageBuf* test = nullptr;
    const OIIO::ImageBuf* error = nullptr; ///< a map of errors from 0 to 1; gives the region
    const OIIO::ImageBuf* stops = nullptr; ///< FlipResult::exposure_stops
    const OIIO::ImageBuf* bias = nullptr;  ///< bias_check()'s map "all"; gives the region, too
    double within = 0;                     ///< the margin of that check
    /// Exposures that were compared, ascending; empty: the image's own.
    std::vector<double> exposures;
    HdrFlipOptions look; ///< how the images were compared, and so how they are shown
    /// Else the images are shown linear, clamped to [0,1], as LDR-FLIP compares them.
    bool hdr = true;
    std::vector<Position> spots; ///< pixels to be shown enlarged
    bool full = true;            ///< draw everything; else only thumbnails and spots
};

/// Images as data URIs; a text is empty where there is no image.
struct ExposurePictures {
    double stops = 0;
    std::string reference, test;
};
struct SpotPictures {
    Position at;
    std::string reference, test, error;
};
struct FramePictures {
    int width = 0, height = 0; ///< size of the large images
    std::vector<ExposurePictures> exposures;
    std::string error, stops; ///< magma from 0 to 1, viridis over the range below
    double first_stop = 0, last_stop = 0;
    std::string bias; ///< the map of --biascheck; colours end at this relative difference
    double bias_range = 0;
    std::vector<SpotPictures> spots;
    std::string small_test, small_error; ///< thumbnails
};

inline constexpr int kPictureSide = 960;   ///< the longest side of a large image
inline constexpr int kThumbnailSide = 160; ///< of a thumbnail
inline constexpr int kSpotRadius = 16;     ///< pixels around a spot to each side
inline constexpr size_t kMostExposures =
    5; ///< shown exposures: both ends, and evenly spaced ones between
inline constexpr size_t kMostSpots = 8;

/// Throws a runtime_error that says what could not be drawn. Non-finite pixels are black, in the
/// enlarged spots magenta.
FramePictures draw_pictures(const PictureRequest& request, int nthreads = 0);

/// The texts that the page holds of a frame: all images, and the thumbnails and spots that every
/// frame has.
std::string full_json(const FramePictures& pictures);
std::string small_json(const FramePictures& pictures);

/// The colours of a map from left to right, as a data URI.
std::string legend_uri(const std::string& map);
std::string bias_legend_uri();

} // namespace tonetool::sequence
