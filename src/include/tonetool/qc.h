// What a dailies check must know of a picture: facts of its header and its pixels, small enough to
// keep for every frame of a shot.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/pixels.h"

namespace tonetool {

struct QcOptions {
    PixelOptions pixels; ///< the picture among the layers
    /// Light groups that are to add up to it, by name or by layer; empty: those that are found.
    std::vector<std::string> groups;
};

/// A pixel, and what it has.
struct QcSpot {
    int x = 0, y = 0;
    double value = 0;  ///< of what is counted where it is finite, else 0
    double around = 0; ///< of a spike: the largest value on the square 3 pixels away
};

/// How many pixels have something, and the first of them.
struct QcCount {
    int64_t pixels = 0;
    std::vector<QcSpot> first; ///< by row, then column; at most kMost
    static constexpr size_t kMost = 4;
};

struct QcLayer {
    std::string name; ///< "" for plain R,G,B
    /// "picture"; "light": a light group of it; "color"; "depth", which may be infinite; "data"
    std::string kind;
    bool constant = false; ///< each channel but alpha has one value
    int64_t lit = 0;       ///< pixels that are finite and not 0
    double min = 0, max = 0;
    double mean = 0; ///< of the luminance of a colour, else of all its values
    QcCount nan, inf, negative;
};

struct QcPart {
    std::string name;
    std::array<int, 4> data{}, display{}; ///< x, y, width, height
    std::string compression;
    /// Everything in the header that is not above; values of more than 120 characters by their
    /// hash.
    std::map<std::string, std::string> metadata;
};

/// The colour that a viewer looks at. A file of data (depth, normals, numbers of objects) has none:
/// no layer is of the kind "picture", and the thumbnail is dark.
struct QcPicture {
    std::string layer, space;
    /// Means of luminance over the display window, kWide x kHigh from the top, in 1/1000 stop, at
    /// least kDark: thumbnails are compared, and must be the same when read back.
    std::vector<int> thumbnail;
    static constexpr int kWide = 32, kHigh = 18, kDark = -30000;
    std::vector<int> peaks; ///< the largest components in the same cells, in the same units
    std::string hash;       ///< of the values of its pixels
    QcCount alpha_low;      ///< below 0 by more than kAlphaSlack, or NaN
    QcCount alpha_high;     ///< above 1 by as much
    static constexpr double kAlphaSlack = 1e-3; ///< of sums of filter weights in half
    int64_t lit = 0;                            ///< pixels with light, where there is an alpha
    QcCount unseen;                             ///< those of them whose alpha is 0
    int64_t spike_count = 0;    ///< pixels 8 times as large as all that are 3 pixels away
    std::vector<QcSpot> spikes; ///< the largest of them, by value; at most kSpikes
    static constexpr size_t kSpikes = 32;
    int groups = 0;              ///< light groups
    double group_sum = 0;        ///< light of all groups over that of the picture
    double group_difference = 0; ///< sum of the pixels' differences, over the same
    QcSpot group_worst;          ///< the pixel that is off most, by how much
};

struct QcFacts {
    std::vector<QcPart> parts;
    std::vector<std::pair<std::string, std::string>> channels; ///< name and type, as in the file
    std::vector<QcLayer> layers;
    QcPicture picture;
};

namespace ToneAlgo {

/// Measure a picture and what comes with it: all parts (subimages) of one file, whose channels are
/// told apart by the names of the parts. One pass over the pixels, in bands of rows: images that
/// were not read are read from their file. False with the reason in `error`: several pictures among
/// the layers, or not the one that was named, deep, unreadable. The pixels at the largest component
/// of the picture, which may be clamped, do not count for its light groups.
TONETOOL_API bool qc_facts(QcFacts& facts, const std::vector<const OIIO::ImageBuf*>& parts,
                           std::string& error, const QcOptions& options = {}, int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
