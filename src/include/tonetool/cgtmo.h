// CG-TMO: local tone mapping of rendered images, guided by the renderer's own G-buffer.
//
// F. Banterle et al., CG-TMO; F. Drago et al., "Adaptive Logarithmic Mapping for Displaying High
// Contrast Scenes" (2003) for the curve.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/lights.h"
#include "tonetool/pixels.h"

namespace tonetool {

struct CgTmoOptions {
    PixelOptions pixels; ///< the beauty and its colour space
    /// "default": a base of log luminance, with a term of 0.4 in log10 of luminance beside the
    /// guides, since emitters, their glow and shadows are not in a G-buffer; "paper": Eq. 2 and 4
    /// to the letter, a base of luminance under the guides alone. What follows overrides.
    std::string preset = "default";
    std::string domain;             ///< of the base: "log", "linear"; empty: the preset's
    std::optional<double> lumsigma; ///< of the luminance term in log10, 0: none, to 10
    /// Guides by the name of their layer, or of a file that has them; "none": without; empty: found
    /// by the names and contents of layers, in the image or in other parts of its file. Positions
    /// that are not there are made of depth along the camera's axis.
    std::string position, normal, albedo, depth;
    /// Horizontal field of view in degrees, 1 to 179, where a camera is needed; unset: that of the
    /// image's worldToCamera and worldToNDC, or 40.
    std::optional<double> fov;
    /// A missing guide, light, or panorama that was asked for is an error, not a warning.
    bool strict = false;
    double sigma = 8;                  ///< of the window in pixels, 1 to 20; its half is 2.5 sigma
    int samples = 80;                  ///< of the window, 4 to 400; 0: all
    std::string normaldist = "euclid"; ///< |n - m|^2, or "dot": 1 - |n m|
    /// "pixel": of each pixel, from its neighbours' positions; "global": the median of those;
    /// "camera": by its distance and field of view; or a number, in the unit of the positions.
    std::string footprint = "pixel";
    /// "guided"; "bilateral": the luminance term alone (Durand and Dorsey 2002); "wls": weighted
    /// least squares of luminance (Farbman et al. 2008); "none": Drago's curve on each pixel.
    std::string filter = "guided";
    /// Of weighted least squares, and given with them alone: how sensitive they are to edges, 0 to
    /// 4 (1.2), and how smooth the base is, 0 to 100 (0.125).
    std::optional<double> wlsalpha, wlslambda;
    /// Adaptation luminance: "geometric", "harmonic", "arithmetic", "median" of the panorama, or
    /// of the image without one; or a number.
    std::string lwa = "geometric";
    std::string env; ///< file of a latitude-longitude panorama at the camera, in the image's unit
    std::string weight = "solidangle"; ///< PanoramaOptions::weight
    std::optional<double> lmax;        ///< luminance that becomes white; unset: as `maximum` says
    /// "lights": of the lights that light the image the largest luminance in `lights.table`;
    /// "groups": the largest luminance in the layers of the light groups; "env": in the panorama;
    /// "image": in the image. What cannot be had is followed by the next. "auto": the first that
    /// was given, groups only if they add up to the image.
    std::string maximum = "auto";
    double max_percentile = 100; ///< of groups and image, instead of their largest; 50 to 100
    LightOptions lights;
    double bias = 0.85;          ///< of Drago's curve, 0.01 to 1
    double ldmax = 100;          ///< cd/m2 of the display, 1 to 10000; 100 counts as 1
    double saturation = 1;       ///< C' = (C / L)^saturation Ld, 0 to 4
    std::string encode = "srgb"; ///< of the result, as TonemapOptions::encode
    bool clamp = true;           ///< the result to [0,1]
    /// "picture"; or what luminance is the product of, in R, G and B alike, linear, neither encoded
    /// nor clamped: "base", which the curve compresses, "detail", which it leaves.
    std::string show = "picture";
};

struct CgTmoSummary {
    std::string layer, space;
    std::string position, normal, albedo, depth; ///< layers that were used; empty: none
    double adaptation = 0, maximum = 0;          ///< Lwa and Lmax
    std::string adaptation_from;                 ///< "lwa", "env", "image"
    std::string maximum_from;                    ///< "lmax", "lights", "groups", "env", "image"
    std::string maximum_light;                   ///< whose maximum it is, of lights and groups
    std::string light_index; ///< where lights were told apart: a layer, "groups"; empty: nowhere
    double footprint = 0;    ///< median, in the unit of positions; 0: unknown
    int samples = 0;         ///< neighbours of each pixel; 0: all (wls)
    int64_t background = 0;  ///< pixels without a surface
    int64_t nonfinite = 0, negative = 0;
    std::vector<std::string> warnings;
    std::vector<std::string> notes; ///< choices that were not the only ones possible
};

namespace ToneAlgo {

/// Tone map the colour of a rendered image: Drago's curve on a base of luminance, the detail
/// multiplied back (Eq. 2); the base by a cross bilateral filter that position, normal and albedo
/// guide (Eq. 4), which are layers of the same image.
///
/// Colour: as tonemap with a curve, in linear Rec.709; every other channel is carried.
/// Missing guides: without a position, normal or albedo the term is left out, with a warning; with
///   none of them the luminance term alone remains.
/// Background (no surface): neighbours of background only.
/// NaN, Inf, negative colour: as tonemap; such pixels take no part in the base, nor do black ones
///   in that of weighted least squares.
/// Weighted least squares are of the whole image whatever the ROI, on one thread, in 0.4 kB a
/// pixel.
///   They hold to 1e-7 of the base, or there is an error and no picture.
/// Results do not depend on the ROI, tiles or threads to the bit.
TONETOOL_API bool cg_tmo(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src,
                         const CgTmoOptions& options = {}, CgTmoSummary* summary = nullptr,
                         OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API OIIO::ImageBuf cg_tmo(const OIIO::ImageBuf& src, const CgTmoOptions& options = {},
                                   CgTmoSummary* summary = nullptr, OIIO::ROI roi = {},
                                   int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
