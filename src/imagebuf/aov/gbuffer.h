// SPDX-License-Identifier: BSD-3-Clause
// What a renderer knows of the surface in each pixel: found by the names of layers, checked by
// their content, cleaned.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tonetool {

/// Layers that the user names instead of those found; "none" leaves a guide out.
struct GuideOptions {
    std::string position, normal, albedo, depth;
    /// The layer of the picture: the guides come from its view layer, where there are several.
    std::string beauty;
};

/// One guide of the image.
struct GuideChannels {
    std::string layer;
    std::shared_ptr<const OIIO::ImageBuf> file; ///< what has them; null: the image itself
    int channel[3] = {-1, -1, -1};              ///< depth has channel[0] only
};

struct GBufferNames {
    std::optional<GuideChannels> position, normal, albedo, depth;
    std::vector<std::string> notes; ///< choices that were not the only ones possible

    bool any() const { return position || normal || albedo || depth; }
};

/// Looks at names only. Finding nothing is no error; a layer the user named that is not there is.
GBufferNames find_gbuffer(const OIIO::ImageSpec& spec, const GuideOptions& options);

/// Guides of a region, row by row. A guide that was not found or failed its check is empty. Pixels
/// that show no surface hold 0 in all of them, so that nothing here is ever NaN or infinite.
struct GBuffer {
    int width = 0, height = 0;
    std::vector<float> position[3];  ///< world or camera space, in the scene's unit
    std::vector<float> normal[3];    ///< unit length
    std::vector<float> albedo[3];    ///< 0..1
    std::vector<float> depth;        ///< > 0
    std::vector<uint8_t> background; ///< 1 where no surface is seen, or none that can be trusted
    int64_t nonfinite = 0;           ///< pixels that are background for a NaN or infinite guide
    double half_ulp = 0;             ///< largest rounding of a stored position; 0 without positions
    bool half_positions = false;     ///< all are numbers that half can hold
    double footprint = 0; ///< median step of the position from pixel to pixel; 0 if there is none
    std::vector<std::string> warnings;

    bool has_position() const { return !position[0].empty(); }
    bool has_normal() const { return !normal[0].empty(); }
    bool has_albedo() const { return !albedo[0].empty(); }
    bool has_depth() const { return !depth.empty(); }
};

/// Reads the guides of a region. What is doubtful about them becomes a warning, not an error.
GBuffer read_gbuffer(const OIIO::ImageBuf& image, const GBufferNames& names, OIIO::ROI region,
                     int nthreads);

} // namespace tonetool
