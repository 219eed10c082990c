// SPDX-License-Identifier: BSD-3-Clause
// Bloom: the glare that bright light makes in the eye, and lenses.
//
// G. Spencer, P. Shirley, K. Zimmerman, D. Greenberg, "Physically-Based Glare Effects for Digital
// Images" (1995), Eq. 1 to 8 for the eye; M. Pettineo, "A Closer Look at Tone Mapping" (2010), for
// the threshold in stops and the sum of Gaussians.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// C' = C + amount (PSF * E - E), E = C max(0, L - threshold) / L: light moves, none is added.
struct BloomOptions {
    PixelOptions pixels; ///< layer and colour space
    /// Luminance, of linear Rec.709 in the image's unit, above which light spreads; or "6s": so
    /// many stops above Lwa, the geometric mean of the means of about 2300 cells of the image.
    std::string threshold = "0";
    double amount = 1; ///< share of that light which spreads, 0 to 1
    /// Point spread function. "spencer": of the eye; "gaussian": the mean of four Gaussians with
    /// sigmas of 1/8, 1/4, 1/2 and 1 radius, to 5 radii.
    std::string psf = "spencer";
    /// What the eye is adapted to, with psf "spencer": "photopic" (day), "mesopic" (dusk) or
    /// "scotopic" (night); the latter two have a coloured halo of 3 degrees about a light.
    std::string vision = "photopic";
    /// Horizontal field of view of the display window in degrees, 1 to 179, with psf "spencer":
    /// all pixels have the angle fov / width. Unset: that of the image's worldToCamera and
    /// worldToNDC, or 40.
    std::optional<double> fov;
    /// In pixels, above 0, to 10000, with psf "gaussian"; unset: 3 % of the display window's width.
    std::optional<double> radius;
};

struct BloomSummary {
    std::string layer, space;
    double threshold = 0;  ///< luminance
    double lwa = 0;        ///< that the threshold in stops is above; 0: it is no such threshold
    double fov = 0;        ///< degrees, with psf "spencer"
    double reach = 0;      ///< how far light is spread, in pixels
    double kept = 0;       ///< share of the spread light that stays in its pixel, of green
    double light = 0;      ///< share of the image's light that is above the threshold
    int64_t spreading = 0; ///< pixels above the threshold
    int64_t nonfinite = 0; ///< pixels with NaN or Inf in R, G or B
    std::vector<std::string> warnings, notes;
};

namespace ToneAlgo {

/// Spread the light of bright pixels, in linear light, before tone mapping.
///
/// Colour: R, G, B of the layer that options choose, in their own primaries; alpha, into which no
///   light is added, and every other channel are carried unchanged. The image must be linear. The
///   result is float; with amount 0 it has the pixels of the image.
/// The spread function of the eye is sampled 15 x 15 times in a pixel, to 30 degrees or the longer
///   side of the data window, and adds up to 1: all light stays, but what leaves the data window.
///   Red, green and blue have wavelengths of 611, 549 and 467 nm; a grey image has that of green.
/// NaN, Inf: such pixels stay as they are and give no light; they are counted and warned about.
///   Negative components stay, too, and give none. Results do not depend on the ROI or threads to
///   the bit; takes about 70 bytes a pixel beside the image where light goes as far as it is wide.
/// Errors: no colour, deep and display-encoded images, unknown names, values out of range, options
///   of the other psf, each with what would be valid.
TONETOOL_API bool bloom(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src,
                        const BloomOptions& options = {}, BloomSummary* summary = nullptr,
                        OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API OIIO::ImageBuf bloom(const OIIO::ImageBuf& src, const BloomOptions& options = {},
                                  BloomSummary* summary = nullptr, OIIO::ROI roi = {},
                                  int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
