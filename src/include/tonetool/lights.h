// What is known of the light of a rendered scene: groups of lights, tables of lights, panoramas.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// Where the lights of an image are told apart, and how bright each of them is.
struct LightOptions {
    /// File of the table of lights; empty: none. `.csv` has lines of index,value, index,r,g,b,
    /// name,value or name,r,g,b (# comments, a header line is allowed). `.json` has "groups" of
    /// "lights", or "lights", or lights by name, or a list; a light is a number, [r, g, b], or an
    /// object with luminance or radiance_rgb, or with power_lum_W or power_rgb_W and area_m2, from
    /// which L = power / (pi area). A group is as bright as its brightest light.
    std::string table;
    /// Of the table's values: "luminance": that of the image; a number: times this they are; or
    /// "power": plain values are powers, which rank lights and are a luminance only with an area.
    std::string unit = "luminance";
    /// Layer that holds the index of a light in each pixel; "groups": made of the light groups
    /// instead; a file that has it alone or under such a name; empty: one that is called so
    /// (lightindex, M, light_id), else the light groups.
    std::string layer;
    /// Of the light groups a pixel has that of the largest "contribution"; or "power": among those
    /// with more than 1 % of the pixel's light that of the largest value in the table.
    std::string index = "contribution";
    /// Light groups, by name or by layer; empty: found by the names renderers give them.
    std::vector<std::string> groups;
};

struct LightGroupSummary {
    std::string name, layer;
    int64_t pixels = 0;              ///< that have its index
    double maximum = 0;              ///< largest luminance in its layer; 0: it is black
    std::optional<double> luminance; ///< by the table
};

struct LightIndexSummary {
    std::string layer, space; ///< of the picture
    std::vector<LightGroupSummary> groups;
    int64_t unlit = 0; ///< pixels without any light, of index -1
    /// Light of all groups over that of the picture, and how far pixels are from it, over the same:
    /// of pixels below the picture's largest component, which may be clamped. 0: there is none.
    double sum = 0, difference = 0;
    std::vector<std::string> warnings;
};

struct PanoramaOptions {
    PixelOptions pixels;
    /// "solidangle": a texel counts as the part of the sphere it covers, which takes a display
    /// window of 2:1; "none": every texel counts alike.
    std::string weight = "solidangle";
};

/// Luminances of a latitude-longitude panorama over its finite pixels.
struct PanoramaStats {
    int64_t pixels = 0;    ///< of the display window
    int64_t nonfinite = 0; ///< not in any figure
    int64_t negative = 0;
    int64_t uncovered = 0;              ///< not in any figure: the data window does not have them
    double geometric = 0, harmonic = 0; ///< of L + 1e-6
    double mean = 0, median = 0, max = 0;
    std::string layer, space;
};

namespace ToneAlgo {

/// Which light a pixel is lit by, from an image with light groups: one float channel `lightindex`
/// with the place of the group in the summary, or -1 where no group has light. The attribute
/// `lightindex:names` has the names, with commas. No groups, or an unknown one, is an error; groups
/// that do not add up to the picture within 5 % raise a warning. NaN, Inf, negative: black.
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
