// SPDX-License-Identifier: BSD-3-Clause
// The images of one frame in the report.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <string>
#include <vector>

#include "sequence/results/results.h"
#include "tonetool/flip.h"

namespace tonetool::sequence {

/// The images to draw. All pointers but `test` may be null.
struct PictureRequest {
    const OIIO::ImageBuf* reference = nullptr;
    const OIIO::ImageBuf* test = nullptr;
    /// By a command whose map a person looks at: another before it leaves the pair to it.
    bool compared = true;
    const OIIO::ImageBuf* error = nullptr;     ///< a map of errors from 0 to 1; gives the region
    const OIIO::ImageBuf* unbounded = nullptr; ///< one of errors without a bound
    const OIIO::ImageBuf* stops = nullptr;     ///< FlipResult::exposure_stops
    const OIIO::ImageBuf* bias = nullptr;      ///< bias_check()'s map "all"; gives the region, too
    double within = 0;                         ///< the margin of that check
    /// Exposures that were compared, ascending; empty: the image's own.
    std::vector<double> exposures;
    HdrFlipOptions look; ///< how the images were compared, and so how thumbnails are shown
    /// Else the images are shown linear, clamped to [0,1], as LDR-FLIP compares them.
    bool hdr = true;
    std::vector<Position> spots; ///< pixels to be shown enlarged, the worst first
    bool full = true;            ///< draw pictures and maps; else only thumbnails and spots
    bool large = true;           ///< and pictures of the full size
    /// And the number of every pixel: of means in a picture of kPictureSide, or of the file.
    enum class Exact { No, Means, All } exact = Exact::No;
};

/// Images as data URIs; a text is empty where there is no image.
struct PairTexts {
    std::string reference, test;
};
struct SpotPictures {
    Position at;
    std::string reference, test, error;
};
/// Half floats of linear Rec.709: their high and low bytes as pictures.
struct NumberTexts {
    std::string high, low;
    std::string alpha; ///< high bytes as red, low ones as green; empty: one value everywhere
    std::optional<double> one_alpha;
};
/// The numbers of a part of the frame.
struct NumberPictures {
    int x = 0, y = 0, width = 0, height = 0; ///< in the file
    int columns = 0, rows = 0;               ///< of numbers, before the picture is turned upright
    NumberTexts reference, test;
    std::string error; ///< as alpha
};
struct FramePictures {
    /// Of the file: where the pictures lie in it, and how it is turned to be upright.
    int x = 0, y = 0, width = 0, height = 0, orientation = 1;
    double start = 0;          ///< the exposure of the largest error, in stops
    std::string space;         ///< of the stored colours, by name
    PairTexts pictures, large; ///< codes of logarithms, of at most kPictureSide and in full size
    PairTexts alpha;           ///< codes from 0 to 1; empty where it is 1 everywhere
    std::string error, stops;  ///< codes from 0 to 1, and over the range below
    double first_stop = 0, last_stop = 0;
    std::string bias; ///< the map of --biascheck; colours end at this relative difference
    double bias_range = 0;
    std::optional<NumberPictures> near, exact; ///< around the worst pixel, and of everything
    std::vector<SpotPictures> spots;
    std::string small_test, small_error; ///< thumbnails
};

inline constexpr int kPictureSide = 960;   ///< the longest side of a reduced image
inline constexpr int kThumbnailSide = 160; ///< of a thumbnail
inline constexpr int kSpotRadius = 16;     ///< pixels around a spot to each side
inline constexpr int kNearSide = 256;      ///< of the square of numbers around the worst pixel
inline constexpr size_t kMostSpots = 8;

/// Throws a runtime_error that says what could not be drawn. Non-finite pixels are black in
/// thumbnails, in the enlarged spots magenta.
FramePictures draw_pictures(const PictureRequest& request, int nthreads = 0);

/// The texts that the page holds of a frame: pictures and maps of the worst frames, pictures of the
/// full size, the number of every pixel, and the thumbnails and spots that every frame has. Empty
/// where nothing of it was drawn.
std::string full_json(const FramePictures& pictures);
std::string large_json(const FramePictures& pictures);
std::string exact_json(const FramePictures& pictures);
std::string small_json(const FramePictures& pictures);

/// The colours of a map from left to right, as a data URI.
std::string legend_uri(const std::string& map);
std::string bias_legend_uri();

} // namespace tonetool::sequence
