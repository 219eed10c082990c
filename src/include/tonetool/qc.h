// SPDX-License-Identifier: BSD-3-Clause
// The facts that a dailies check needs of an image: from its header and its pixels, small enough to
// keep for every frame of a shot.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/pixels.h"

namespace tonetool {

struct QcOptions {
    PixelOptions pixels; ///< the beauty among the layers
    /// Light groups that must add up to the beauty, by name or by layer; empty: those that are
    /// found.
    std::vector<std::string> groups;
};

/// A pixel with a fault.
struct QcSpot {
    int x = 0, y = 0;
    double value = 0; ///< its value where that is finite, else 0
    /// For a firefly: the neighbourhood maximum, the largest value at a distance of 3 pixels.
    double around = 0;
};

/// How many pixels have a fault, and the first of them.
struct QcCount {
    int64_t pixels = 0;
    std::vector<QcSpot> first; ///< by row, then column; at most kMost
    static constexpr size_t kMost = 4;
};

struct QcLayer {
    std::string name; ///< "" for plain R,G,B
    /// "picture": the beauty; "light": a light group of it; "color"; "albedo"; "depth", which may
    /// be infinite; "position"; "normal"; "motion"; "id", of objects; "data"
    std::string kind;
    /// Of the values of a depth, position or id without filter: equal where camera and geometry
    /// are.
    std::string hash;
    bool constant = false; ///< each channel but alpha has one value
    int64_t lit = 0;       ///< pixels that are finite and not 0
    double min = 0, max = 0;
    double mean = 0; ///< of the luminance if the layer is a colour, else of all its values
    QcCount nan, inf, negative;
};

/// A layer without noise in the cells of QcPicture's thumbnail, which tells what moves.
struct QcGuide {
    std::string layer;
    int channels = 0;
    /// Of each cell the means of the channels, by code(); what is beyond 1e9, or not finite, counts
    /// as 0.
    std::vector<int16_t> cells;
    /// sign(x) log2(1 + 1000 |x|) in 1/1000: relative above 0.001, linear below, in 16 bits.
    static int16_t code(double value) {
        const double size = std::round(1000 * std::log2(1 + 1000 * std::abs(value)));
        return int16_t(std::copysign(std::min(size, 32767.0), value));
    }
    static double value(int code) {
        return std::copysign((std::exp2(std::abs(code) / 1000.0) - 1) / 1000, code);
    }
};

struct QcObject {
    uint32_t id = 0; ///< the bits of its ID
    int64_t pixels = 0;
};

/// Which objects a frame shows, by the bits of their IDs: the first layer of IDs with "object" in
/// its name, else the first; of a Cryptomatte those of the largest coverage. An ID of 0 is nothing.
struct QcObjects {
    std::string layer; ///< "" if there is none
    /// The largest that take at least kShare of the pixels and are seen away from the left and the
    /// right border alone, where the other eye of a stereo pair may not see them; by size.
    std::vector<QcObject> inside;
    static constexpr size_t kMost = 32;
    static constexpr double kShare = 0.001, kBorder = 0.08; ///< of the picture; of its width
    /// Two bits of kBits for each ID that there is.
    std::vector<uint8_t> known;
    static constexpr size_t kBits = 4096;
    static std::array<size_t, 2> bits_of(uint32_t id) {
        const uint32_t one = id * 0x9e3779b1U, other = (id ^ id >> 15) * 0x85ebca6bU;
        return {one >> 20, other >> 20};
    }
    /// False: no pixel has this ID. True may be chance.
    bool knows(uint32_t id) const {
        const auto bits = bits_of(id);
        return std::all_of(bits.begin(), bits.end(), [&](size_t bit) {
            return bit / 8 < known.size() && (known[bit / 8] >> bit % 8 & 1) != 0;
        });
    }
};

struct QcPart {
    std::string name;
    std::array<int, 4> data{}, display{}; ///< x, y, width, height
    std::string compression;
    /// All other attributes of the header; values of more than 120 characters as their hash.
    std::map<std::string, std::string> metadata;
};

/// Pixels of the beauty that have one exact colour, which the noise of a render never makes.
struct QcRectangle {
    int x = 0, y = 0, width = 0, height = 0;
    std::array<float, 3> color{}; ///< as in the file, without -0 and with one kind of NaN
    bool background = false;      ///< in 90 % of it the depth is that of nothing
};

/// The shares, in per cent, of the pixels of a border that equal the pixel inside of them: in 32
/// parts of it, from left to right or from the top.
struct QcBorders {
    std::array<int, 32> left{}, right{}, top{}, bottom{};
};

/// Statistics of the beauty. A file of data (depth, normals, object IDs) has no beauty: no layer is
/// of the kind "picture", and the thumbnail is dark.
struct QcPicture {
    std::string layer, space;
    /// Means of luminance over the display window, kWide x kHigh from the top, in 1/1000 stop, at
    /// least kDark: whole numbers, since thumbnails are compared and must be the same when they are
    /// read back.
    std::vector<int16_t> thumbnail;
    static constexpr int kWide = 32, kHigh = 18, kDark = -30000;
    /// Of the mean colours of the same cells: red and blue over green in 1/32 stop, -128 to 127.
    std::vector<int16_t> red, blue;
    /// The largest components in kPeaksWide x kPeaksHigh cells, in 1/8 stop, at least kPeakDark.
    std::vector<int16_t> peaks;
    static constexpr int kPeaksWide = 64, kPeaksHigh = 36, kPeakDark = -112, kPeakBright = 143;
    /// In the middle of these finer cells: 16 bits that tell 4 x 4 pixels, 0 where they have one
    /// colour.
    std::vector<uint16_t> fingerprints;
    std::string hash;   ///< hash of its pixel values
    QcCount alpha_low;  ///< below 0 by more than kAlphaSlack, or NaN
    QcCount alpha_high; ///< above 1 by as much
    QcObjects objects;  ///< also of a file that has no beauty
    /// Rounding of filter weights that are added up in half float.
    static constexpr double kAlphaSlack = 1e-3;
    int64_t lit = 0; ///< non-black pixels, counted only where there is an alpha
    QcCount unseen;  ///< non-black pixels whose alpha is 0
    /// Fireflies: pixels 8 times as large as all at a distance of 3 pixels.
    int64_t spike_count = 0;
    std::vector<QcSpot> spikes; ///< the largest fireflies, by value; at most kSpikes
    static constexpr size_t kSpikes = 64;
    /// The largest rectangles of at least 8 x 8 pixels of one colour, by row, then column; none
    /// that fills the picture.
    std::vector<QcRectangle> rectangles;
    static constexpr size_t kRectangles = 16;
    QcBorders borders;
    double alpha_mean = 0;  ///< of its finite alpha; 0 without an alpha
    double alpha_clear = 0; ///< the share of pixels whose alpha is 0; 0 without an alpha
    /// The shares of pixels that equal their right neighbour, of those in even and in odd columns:
    /// one of them is nearly 1 and the other small where each pixel was written twice.
    std::array<double, 2> pairs{};
    int64_t greens = 0; ///< pixels whose green is above 0.01 and below 1
    int distinct = 0;   ///< different values of these, at most 1000
    /// Medians over lit pixels, in stops: the distance from the mean of the four neighbours, the
    /// same of means of 2 x 2 pixels, the distances from the pixel to the left and from that above.
    double fine = 0, coarse = 0, across = 0, down = 0;
    /// Pixels with all channels lit, one exactly 1 and another not, as a clamp leaves them; with a
    /// channel at one of the two half floats beside 1, by chance; with a channel at 65504.
    int64_t at_one = 0, beside_one = 0, at_largest_half = 0;
    double magenta = 0; ///< share of an albedo that is magenta, as where a texture lacks
    double speed = 0; ///< of a motion layer: the 95th percentile of its absolute values, in pixels
    int groups = 0;   ///< light groups
    double group_sum = 0;        ///< light of all groups divided by that of the beauty
    double group_difference = 0; ///< sum of the pixels' differences, divided by the same
    QcSpot group_worst;          ///< the pixel with the largest difference, and that difference
};

struct QcFacts {
    std::vector<QcPart> parts;
    std::vector<std::pair<std::string, std::string>> channels; ///< name and type, as in the file
    std::vector<QcLayer> layers;
    /// The first two that there are of a depth, a normal, a position, an albedo.
    std::vector<QcGuide> guides;
    QcPicture picture;
};

namespace ToneAlgo {

/// Measure the beauty and all other layers in all subimages of one file; the names of subimages
/// tell their channels apart. It takes one pass over the pixels, in scanline blocks: images that
/// were not read are read from their file. Returns false with the reason in `error` where several
/// layers could be the beauty, the named one is not there, or an image is deep or unreadable.
/// Pixels at the largest component of the beauty, which may be clamped, count in the check of its
/// light groups only where there are no others.
TONETOOL_API bool qc_facts(QcFacts& facts, const std::vector<const OIIO::ImageBuf*>& parts,
                           std::string& error, const QcOptions& options = {}, int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
