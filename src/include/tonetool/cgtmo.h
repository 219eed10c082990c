// SPDX-License-Identifier: BSD-3-Clause
// CG-TMO: local tone mapping of rendered images, guided by the renderer's own G-buffer.
//
// F. Banterle et al., CG-TMO; F. Drago et al., "Adaptive Logarithmic Mapping for Displaying High
// Contrast Scenes" (2003) for the curve.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/camera_numbers.h"
#include "tonetool/export.h"
#include "tonetool/lights.h"
#include "tonetool/pixels.h"
#include "tonetool/shot_numbers.h"

namespace tonetool {

/// What CG-TMO needs of one frame to steady others, about 41 bytes a pixel: steady_frame() makes
/// it.
struct SteadyPlanes;
using SteadyFrame = std::shared_ptr<const SteadyPlanes>;

/// The camera's settings are of method "camera" alone.
struct CgTmoOptions : CameraOptions {
    PixelOptions pixels; ///< the beauty and its colour space
    /// "default": the base keeps edges of light (`base`), and the statistics are those of a scene
    /// (`count`, `lwa`, `max_percentile`); "classic": the base is a mean of log luminance, and
    /// beside the G-buffer AOVs a luminance term (0.4 in log10) guides the filter, since emitters,
    /// their glow and shadows are not in a G-buffer; the statistics are those of all pixels;
    /// "paper": Eq. 2 and 4 to the letter, the base is a mean of luminance over the whole window
    /// that the G-buffer AOVs alone guide.
    /// Empty: "default", with the filters that have a base of their own "classic". The options
    /// below override the preset.
    std::string preset;
    /// "mean": the base is the mean that the filter makes; "edges": a linear function of log
    /// luminance in each window, by its mean and variance there, which neither turns the order of
    /// two luminances round nor amplifies noise. Empty: the preset's.
    std::string base;
    /// What varies by more than this is an edge of light, in natural logarithms of luminance; 0.001
    /// to 10 (0.16), with base "edges" alone.
    std::optional<double> edge;
    /// How much of the noise's variance is no detail; 0, none, to 100 (2), with base "edges" alone.
    std::optional<double> denoise;
    /// Layer of one channel that holds the variance of the mean of luminance, as a renderer
    /// estimates it; empty: it is measured where surfaces are flat. With base "edges" alone.
    std::string noise;
    /// Steadies detail in time: luminance, and the mean and variance that its base follows from,
    /// are averaged over the frames up to 4 before and after between two cuts, along the surfaces
    /// that positions tell. A mean where the local light changes by more than about a tenth is of
    /// this frame alone, so that nothing lags. With base "edges" and a shot (`adapt`, its `frame`)
    /// alone.
    bool steady = false;
    /// The frames that steady_window() names, this one among them, each made by steady_frame() with
    /// these options; others are not looked at.
    std::map<int, SteadyFrame> frames;
    /// Layer of four channels for surfaces that move, as Blender's Vector: X, Y: where the surface
    /// was in the frame before less where it is, Z, W: where it is less where it will be in the
    /// next one, in pixels, y up. Empty: such surfaces are as they are in each frame.
    std::string motion;
    std::string domain;             ///< of the base: "log", "linear"; empty: the preset's
    std::optional<double> lumsigma; ///< of the luminance term in log10, 0: none, to 10
    /// The G-buffer AOVs that guide the filter: each is the name of a layer or of a file that holds
    /// it; "none": do without it; empty: found by the names and contents of layers, in the image or
    /// in other subimages of its file. Missing positions are reconstructed from depth along the
    /// camera's axis.
    std::string position, normal, albedo, depth;
    /// Horizontal field of view in degrees, 1 to 179, where a camera is needed; unset: that of the
    /// image's worldToCamera and worldToNDC, or 40.
    std::optional<double> fov;
    /// An AOV, light or panorama that was requested but is missing is an error, not a warning.
    bool strict = false;
    double sigma = 8; ///< of the window in pixels, 1 to 20; the window's radius is 2.5 sigma
    /// Neighbours that are sampled in the window, 4 to 400; 0: all. Unset: the preset's.
    std::optional<int> samples;
    std::string normaldist = "euclid"; ///< |n - m|^2, or "dot": 1 - |n m|
    /// The footprint of a pixel in the scene. "pixel": each pixel's own, from its neighbours'
    /// positions; "global": the median of those; "camera": from its distance and the field of view;
    /// or a number in the unit of the positions.
    std::string footprint = "pixel";
    /// "guided"; "bilateral": the luminance term alone (Durand and Dorsey 2002); "wls": weighted
    /// least squares of luminance (Farbman et al. 2008); "none": Drago's curve on each pixel.
    std::string filter = "guided";
    /// Parameters of weighted least squares, valid with that filter alone: the sensitivity to
    /// edges, 0 to 4 (1.2), and the smoothness of the base, 0 to 100 (0.125).
    std::optional<double> wlsalpha, wlslambda;
    /// Which pixels are measured. "lit": those that show something, neither black on the background
    /// nor of alpha 0; "all": every finite pixel. Empty: the preset's.
    std::string count;
    /// "measured": Lwa is what `lwa` says; "camera": it is what a camera of these settings is
    /// exposed for, 0.104 of the luminance that saturates it (ISO 12232), in cd/m2 over adapt.unit.
    std::string method = "measured";
    /// Adaptation luminance: "geometric", "harmonic", "arithmetic", "median" of the panorama, or
    /// of the image without one; "cells": the geometric mean of the means of about 2300 square
    /// cells of the image, which noise hardly moves, or that of the panorama's pixels; or a number.
    /// Empty: the preset's.
    std::string lwa;
    /// File of a latitude-longitude panorama from the camera's position, in the image's unit.
    std::string env;
    std::string weight = "solidangle"; ///< PanoramaOptions::weight
    std::optional<double> lmax;        ///< luminance that becomes white; unset: as `maximum` says
    /// The source of Lmax. "lights": the largest luminance in `lights.table` among the lights that
    /// light the image; "groups": the largest luminance in the layers of the light groups; "env":
    /// in the panorama; "image": in the image. Where a source is not available the next one is
    /// used. "first": the first source that was given, groups only if they add up to the image;
    /// "auto": the lights if there is a table, else the image. Empty: the preset's.
    std::string maximum;
    /// Percentile of groups and image that replaces their maximum; 50 to 100. With count "lit" all
    /// larger luminances of the image are passed over, at least one below 100. Unset: the preset's.
    std::optional<double> max_percentile;
    LightOptions lights;
    /// The shot that Lwa and Lmax are of, where they would be the image's: as it is exposed, so are
    /// its other frames. Its statistics are those of count "lit", lwa "cells" or "geometric",
    /// max_percentile 99.99.
    AdaptOptions adapt;
    double bias = 0.85;          ///< of Drago's curve, 0.01 to 1
    double ldmax = 100;          ///< cd/m2 of the display, 1 to 10000; 100 counts as 1
    double saturation = 1;       ///< C' = (C / L)^saturation Ld, 0 to 4
    std::string encode = "srgb"; ///< encoding of the result, as TonemapOptions::encode
    bool clamp = true;           ///< clamp the result to [0,1]
    std::string clip;            ///< how, as TonemapOptions::clip; empty: the preset's
    /// "picture": the tone-mapped image; or one factor of luminance, the same in R, G and B,
    /// linear, neither encoded nor clamped: "base", which the curve compresses, or "detail", which
    /// it leaves; or, with base "edges", "share": how much of what a pixel differs by from the mean
    /// about it is in its base, 0 to 1.
    std::string show = "picture";
};

struct CgTmoSummary {
    std::string layer, space;
    std::string position, normal, albedo, depth; ///< the layers that were used; empty: none
    double adaptation = 0, maximum = 0;          ///< Lwa and Lmax
    std::string adaptation_from;                 ///< "lwa", "camera", "env", "shot", "image"
    double unit = 0;             ///< cd/m2 of a pixel value of 1, with a camera; else 0
    std::optional<double> ev100; ///< CalibrationSummary::ev100
    std::string maximum_from;    ///< "lmax", "lights", "groups", "env", "shot", "image"
    std::string adapted;         ///< "shot of frames 1 to 8", if "shot" is one of these; else empty
    std::vector<int> steady;     ///< the frames that steady averages; empty: none
    std::string maximum_light;   ///< the light or light group with that maximum
    /// Where the index of a pixel's light came from: a layer, "groups"; empty: no index.
    std::string light_index;
    double footprint = 0;   ///< median, in the unit of positions; 0: unknown
    int samples = 0;        ///< neighbours of each pixel; 0: all (wls)
    int64_t background = 0; ///< pixels without a surface
    int64_t counted = 0;    ///< pixels whose light was measured
    int64_t nonfinite = 0, negative = 0;
    std::vector<std::string> warnings;
    std::vector<std::string> notes; ///< choices among several candidates
};

namespace ToneAlgo {

/// Tone map the colour of a rendered image: Drago's curve compresses the base of luminance, and the
/// detail is multiplied back (Eq. 2). The base is made by a cross bilateral filter that is guided
/// by position, normal and albedo (Eq. 4), which are layers of the same image.
///
/// Colour: as tonemap with a curve, in linear Rec.709; every other channel is carried. Missing
/// AOVs: without position, normal or albedo its term is left out, with a warning; without all of
/// them a base "edges" has neighbours by distance alone, without a warning, and a base "mean" the
/// luminance term. Background (no surface): only background pixels are its
/// neighbours. NaN, Inf, negative colour: as tonemap; such pixels take no part in the base, nor do
/// black ones in that of weighted least squares. Weighted least squares are solved for the whole
/// image whatever the ROI, on one thread, and take 0.4 kB of memory for each pixel. They are solved
/// to 1e-7 of the base; if that fails, it is an error and there is no image. Results do not depend
/// on the ROI, tiles or threads to the bit.
TONETOOL_API bool cg_tmo(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src,
                         const CgTmoOptions& options = {}, CgTmoSummary* summary = nullptr,
                         OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API OIIO::ImageBuf cg_tmo(const OIIO::ImageBuf& src, const CgTmoOptions& options = {},
                                   CgTmoSummary* summary = nullptr, OIIO::ROI roi = {},
                                   int nthreads = 0);

/// What steady needs of one frame, itself and others: log luminance, its mean and variance, noise,
/// position, normal and albedo of each pixel, and the camera that sees the positions where they
/// are, by a direct linear transform (R. Hartley, A. Zisserman, "Multiple View Geometry in Computer
/// Vision", 2003). `options` are those of cg_tmo; `frames` and `adapt` are not looked at.
///
/// Any size: frames need not have one. NaN and Inf: as cg_tmo; a pixel whose position is not finite
/// shows no surface. Errors: as cg_tmo, and a `motion` that is not there; returns false with the
/// reason in `error`. Positions that fit no camera (99 % of them within 0.25 pixels), those of
/// depth and those of one plane are no error: such a frame is tone mapped alone, with a warning,
/// and no history of others. The same bits with any number of threads.
TONETOOL_API bool steady_frame(SteadyFrame& frame, const OIIO::ImageBuf& src, std::string& error,
                               const CgTmoOptions& options = {}, int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
