// SPDX-License-Identifier: BSD-3-Clause
// Which pixels of an image a function reads: layer, colour space, geometry, alpha.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <utility>
#include <vector>

#include "tonetool/export.h"

namespace tonetool {

/// How two images of different display windows are brought together.
enum class SizePolicy {
    Match,  ///< different display windows are an error (the default)
    Resize, ///< the test image is resized to the reference's display window
    Crop,   ///< only the intersection of the display windows is compared
};

/// The role of alpha in a comparison.
enum class AlphaPolicy {
    Ignore, ///< alpha is not compared; RGB is used as stored (associated)
    Error,  ///< |alpha difference| joins the map (the larger of the two wins) and the summary
};

/// How to find the linear Rec.709 colour in an image.
struct PixelOptions {
    /// The layer whose R, G, B are used ("ViewLayer.Combined": the channel names before ".R"), or
    /// whose single channel is used as grey. Empty: plain R,G,B; else the one obvious beauty layer;
    /// else the single channel of an image without colours; else an error that lists the layers.
    /// Layers and subimages whose names say that they hold data (normals, albedo, positions, depth)
    /// are used only if they are named here.
    std::string layer;
    /// Colour space of the stored values, one of color_spaces(): rec709, acescg, aces2065-1,
    /// rec2020, p3-d65 (all linear, with their usual aliases) or srgb (display-encoded, decoded
    /// first).
    /// Empty: the `chromaticities` attribute, else `oiio:ColorSpace` (or `colorInteropID`
    /// where that says no more than "linear"), else sRGB for integer
    /// files and linear Rec.709 for floating-point ones. The gamma of a PNG file is applied, too,
    /// and the EXPOSURE of a Radiance file is divided out whatever the space.
    std::string from;
    /// File of an OpenColorIO configuration whose colour spaces `from` may name, too, and values of
    /// its context variables. hdr_flip() takes those of its view.
    std::string config{};
    std::vector<std::pair<std::string, std::string>> context{};
};

/// The choice of `find_color`.
struct ColorChoice {
    int r = -1, g = -1, b = -1;   ///< channel indices; all the same for an image of one channel
    int a = -1;                   ///< index of the layer's alpha, -1 if it has none
    std::string layer;            ///< "" for plain R,G,B or one plain channel
    std::string space;            ///< name of the colour space that the values are read in
    bool display_encoded = false; ///< values are display-encoded and are decoded on reading

    bool grey() const { return r >= 0 && r == g && r == b; }
};

namespace ToneAlgo {

/// Choose the colour channels and the colour space of an image from its header, as every function
/// of this library does. Returns false and explains in `error` (listing the layers of the image)
/// when there is no colour, or two candidates for the beauty.
TONETOOL_API bool find_color(const OIIO::ImageSpec& spec, const PixelOptions& options,
                             ColorChoice& choice, std::string& error);

/// Names of all layers that have R, G and B; the plain R,G,B is listed as "R,G,B".
TONETOOL_API std::vector<std::string> color_layers(const OIIO::ImageSpec& spec);

/// Names of the colour spaces that PixelOptions::from takes; each has aliases.
TONETOOL_API std::vector<std::string> color_spaces();

} // namespace ToneAlgo
} // namespace tonetool
