// The pictures of one frame in the report.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "sequence/results/results.h"
#include "tonetool/flip.h"

namespace tonetool::sequence {

/// What is drawn. Pointers may be null but for `test`.
struct PictureRequest {
    const OIIO::ImageBuf* reference = nullptr;
    const OIIO::ImageBuf* test = nullptr;
    const OIIO::ImageBuf* error = nullptr; ///< a map of errors from 0 to 1; gives the region
    const OIIO::ImageBuf* stops = nullptr; ///< FlipResult::exposure_stops
    std::vector<double> exposures; ///< that were compared, ascending; empty: the picture's own
    HdrFlipOptions look;           ///< how the images were compared, and so how they are shown
    bool hdr = true;               ///< else linear, clamped to [0,1], as LDR-FLIP compares
    std::vector<Position> spots;   ///< pixels to be seen from near
    bool full = true;              ///< else only the thumbnails and spots
};

/// Pictures as data URIs; an empty text where there is none.
struct ExposurePictures {
    double stops = 0;
    std::string reference, test;
};
struct SpotPictures {
    Position at;
    std::string reference, test, error;
};
struct FramePictures {
    int width = 0, height = 0; ///< of the large pictures
    std::vector<ExposurePictures> exposures;
    std::string error, stops; ///< magma of 0 to 1, viridis of the range below
    double first_stop = 0, last_stop = 0;
    std::vector<SpotPictures> spots;
    std::string small_test, small_error; ///< thumbnails
};

inline constexpr int kPictureSide = 960;    ///< longer side of a large picture at most
inline constexpr int kThumbnailSide = 160;  ///< of a thumbnail
inline constexpr int kSpotReach = 16;       ///< pixels around a spot to each side
inline constexpr size_t kMostExposures = 5; ///< that are shown: both ends and evenly between
inline constexpr size_t kMostSpots = 8;

/// A runtime_error says what could not be drawn. Non-finite pixels are black, and magenta in spots.
FramePictures draw_pictures(const PictureRequest& request, int nthreads = 0);

/// The texts that the page holds of a frame: everything, and only what every frame has.
std::string full_json(const FramePictures& pictures);
std::string small_json(const FramePictures& pictures);

/// The colours of a map from left to right, as a data URI.
std::string legend_uri(const std::string& map);

} // namespace tonetool::sequence
