// SPDX-License-Identifier: BSD-3-Clause
// The lights of a rendered scene: light groups, tables of lights, panoramas.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// How to find the light that lights each pixel, and the luminance of each light.
struct LightOptions {
    /// File of the table of lights; empty: none. `.csv` has lines of index,value, index,r,g,b,
    /// name,value or name,r,g,b (# comments, a header line is allowed). `.json` has "groups" of
    /// "lights", or "lights", or lights by name, or a list; a light is a number, [r, g, b], or an
    /// object with luminance or radiance_rgb, or with power_lum_W or power_rgb_W and area_m2, from
    /// which L = power / (pi area). A group is as bright as its brightest light.
    std::string table;
    /// The unit of the table's values. "luminance": the image's unit; a number: the factor that
    /// converts them to the image's unit; or "power": plain values are powers, which rank lights
    /// and give a luminance only together with an area.
    std::string unit = "luminance";
    /// The layer that holds the index of a light in each pixel; or a file that holds it alone or
    /// under such a name; "groups": the index is computed from the light groups. Empty: the layer
    /// with a usual name (lightindex, M, light_id), else the light groups.
    std::string layer;
    /// How the light of a pixel is chosen among the light groups. "contribution": the group with
    /// the most light there; "power": among the groups with more than 1 % of the pixel's light, the
    /// one with the largest value in the table.
    std::string index = "contribution";
    /// Light groups, by name or by layer; empty: found by the names that renderers give them.
    std::vector<std::string> groups;
};

struct LightGroupSummary {
    std::string name, layer;
    int64_t pixels = 0;              ///< pixels that have its index
    double maximum = 0;              ///< largest luminance in its layer; 0: it is black
    std::optional<double> luminance; ///< luminance from the table
};

struct LightIndexSummary {
    std::string layer, space; ///< of the picture
    std::vector<LightGroupSummary> groups;
    int64_t unlit = 0; ///< black pixels, which have the index -1
    /// Above this difference groups do not add up to the beauty.
    static constexpr double kMostDifference = 0.05;
    /// The light of all groups divided by that of the beauty, and the sum of the pixels'
    /// differences divided by the same, each over R, G and B. Pixels at the beauty's largest
    /// component, which may be clamped, count only where there are no others. 0: there are no
    /// groups.
    double sum = 0, difference = 0;
    std::vector<std::string> warnings;
};

struct PanoramaOptions {
    PixelOptions pixels;
    /// "solidangle": a texel counts by its solid angle, which requires a display window of 2:1;
    /// "none": all texels count alike.
    std::string weight = "solidangle";
};

/// Luminances of a latitude-longitude panorama over its finite pixels.
struct PanoramaStats {
    int64_t pixels = 0;    ///< of the display window
    int64_t nonfinite = 0; ///< pixels with NaN or Inf, not in any figure
    int64_t negative = 0;
    int64_t uncovered = 0;              ///< pixels outside the data window, not in any figure
    double geometric = 0, harmonic = 0; ///< of L + 1e-6
    double mean = 0, median = 0, max = 0;
    std::string layer, space;
};

namespace ToneAlgo {

/// The light that lights each pixel, from an image with light groups: one float channel
/// `lightindex` with the index of the group in the summary, or -1 where all groups are black. The
/// attribute `lightindex:names` lists the names, separated by commas. An image without groups, or
/// an unknown group, is an error; groups that do not add up to the beauty within 5 % raise a
/// warning. NaN, Inf, negative: black.
TONETOOL_API bool light_index(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src,
                              const LightOptions& lights = {}, const PixelOptions& options = {},
                              LightIndexSummary* summary = nullptr, OIIO::ROI roi = {},
                              int nthreads = 0);
TONETOOL_API OIIO::ImageBuf light_index(const OIIO::ImageBuf& src, const LightOptions& lights = {},
                                        const PixelOptions& options = {},
                                        LightIndexSummary* summary = nullptr, OIIO::ROI roi = {},
                                        int nthreads = 0);

/// Measure a panorama. Returns false with the reason in `error`: no colour, no finite pixel, deep,
/// or not 2:1 where solid angles are to count.
TONETOOL_API bool panorama_stats(PanoramaStats& stats, const OIIO::ImageBuf& src,
                                 std::string& error, const PanoramaOptions& options = {},
                                 int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
