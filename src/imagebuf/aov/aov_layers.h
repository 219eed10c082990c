// SPDX-License-Identifier: BSD-3-Clause
// The layers of an image, whatever they hold, by the names of their channels.
#pragma once

#include <OpenImageIO/imageio.h>
#include <string>
#include <vector>

#include "imagebuf/aov/aov_names.h"

namespace tonetool {

/// Channels that differ in their last part only: `P.X`, `P.Y`, `P.Z` or `Px`, `Py`, `Pz`.
struct AovLayer {
    std::string
        name; ///< "ViewLayer.Denoising Normal"; that of the part where the channels have none
    std::string view_layer; ///< "ViewLayer": what layers of one picture share; often ""
    std::string layer_name; ///< "Denoising Normal"
    std::string pass;       ///< "denoisingnormal"
    bool plain = false;     ///< its channels are called R, G, B, Z and no more
    int xyz[3] = {-1, -1, -1};
    int rgb[3] = {-1, -1, -1};
    bool twice = false; ///< a colour is there in two spellings, "R" and "red"
    int t = -1;         ///< Mitsuba's component of a distance
    int first = -1;     ///< its first channel
    int count = 0;
    int alpha = -1;
    std::vector<int> channels; ///< all, in the order of the file

    bool has_rgb() const { return rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0; }
    bool has_xyz() const { return xyz[0] >= 0 && xyz[1] >= 0 && xyz[2] >= 0; }
    bool has_lone_z() const { return xyz[2] >= 0 && xyz[0] < 0 && xyz[1] < 0; }
    /// Three channels of a vector or a colour, or null.
    const int* triple() const { return has_xyz() ? xyz : has_rgb() ? rgb : nullptr; }
    /// The channel of a quantity that needs only one, or -1.
    int scalar() const;
};

/// What a part of a file is called; often "".
std::string part_name(const OIIO::ImageSpec& spec);

/// In the order of the file.
std::vector<AovLayer> aov_layers(const OIIO::ImageSpec& spec);

struct LayerName {
    std::string view_layer, layer_name;
};
/// "ViewLayer" and "Combined" of "ViewLayer.Combined".
LayerName split_layer(const std::string& layer);

} // namespace tonetool
