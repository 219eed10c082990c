// SPDX-License-Identifier: BSD-3-Clause
// Showing HDR images: tone curves, calibration, and the views of OpenColorIO configurations.
//
// M. Pettineo, "A Closer Look at Tone Mapping" (2010), the sources that ToneAlgo::tone_curves()
// names for each curve, and OpenColorIO 2.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tonetool/camera_numbers.h"
#include "tonetool/export.h"
#include "tonetool/pixels.h"
#include "tonetool/shot_numbers.h"

namespace tonetool {

/// A tone curve of the registry, a measured one in a file, or six coefficients.
struct CurveOptions {
    /// See ToneAlgo::tone_curves(). With a '.' or a '/' it is a file that holds a table, of x and
    /// one result or R, G, B: .spi1d, .cube of one dimension, .csv (x,y or x,r,g,b), what
    /// OpenColorIO reads as one table of one dimension (.clf), or camera responses as the text of
    /// the DoRF database or of the EMoR model. Between its rows are straight lines, its ends are
    /// held, and it is applied per channel.
    std::string name = "aces";
    /// Parameters of the curve by name; the others have their defaults. A file has `white` alone:
    /// the scene light that is x = 1 in it (1).
    std::map<std::string, double> parameters;
    /// Parameters with a value for each of R, G and B, of curves that can have them ("film").
    std::map<std::string, std::vector<double>> channel_parameters;
    /// y = (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5) (HDR-FLIP paper, Eq. 1) instead of the name.
    /// Of an EMoR file: the weights of its base functions, as many as it has or fewer.
    std::vector<double> coeffs;
    /// Which curve of a file with several camera responses. If there are NAMERed, NAMEGreen and
    /// NAMEBlue (also with a '-' or '_'), NAME is all three.
    std::string curve_name;
    /// What x of a file is: "linear", or the logarithm "log2" or "log10" of light.
    std::string table_input = "linear";
    /// What a file's results are: "linear" display light; "encoded" as the picture will be, so that
    /// they are decoded here; "density" D, light is 10^-(D - Dmin), Dmin the least of a channel.
    std::string table_output = "linear";
    /// "rgb": apply the curve to each channel; "luminance": T(L) (C/L)^saturation; empty: as the
    /// curve was published. Curves that mix the channels (agx, neutral, aces-hill) have no choice.
    std::string on;
    double saturation = 1; ///< for curves on luminance, 0 to 4
};

/// A display and a view of an OpenColorIO configuration.
struct ViewOptions {
    std::string config;  ///< file of the configuration; empty: the environment variable OCIO
    std::string display; ///< empty: the configuration's default
    std::string view;    ///< empty: the display's default
    std::string looks;   ///< OCIO looks that replace the view's own; empty: the view's own
    /// Context variables and their values, in place of the environment's.
    std::vector<std::pair<std::string, std::string>> context;
};

/// How the exposure of an image is found.
enum class CalibrationMethod {
    Manual,  ///< 2^stops
    Mean,    ///< key / geometric mean of the luminance, times 2^stops
    AutoKey, ///< as Mean, but the key follows from the mean in cd/m2 (Krawczyk et al. 2005): 1.03 -
             ///< 2 / (2 + log10(1 + mean unit))
    /// By a camera, ISO 12232: the luminance that saturates its sensor, 78 N^2 / (0.65 S T) cd/m2,
    /// becomes 1, times 2^stops. Nothing is measured.
    Camera,
};

/// The camera's settings are of CalibrationMethod::Camera alone; the unit is AdaptOptions::unit.
struct CalibrationOptions : CameraOptions {
    CalibrationMethod method = CalibrationMethod::Manual;
    double stops = 0;  ///< -126 to 126
    double key = 0.18; ///< the value that the mean is brought to, with Mean; 1e-4 to 100
    /// Local means: 2^level x 2^level cells over the image, interpolated bilinearly between their
    /// middles (the article's MIP levels, counted from the top). 0: one mean for the image. The
    /// largest valid level is the last one whose cells are at least a pixel wide.
    int level = 0;
    /// Which pixels are in the statistics. "lit": those that show something: neither black on the
    /// background, nor of alpha 0; "all": every finite pixel. Empty: "lit", with one of the
    /// switches below "all".
    std::string count;
    /// "pixels": the mean is of pixels; "cells": of the means of about 2300 square cells, which the
    /// noise of pixels hardly moves.
    std::string means = "pixels";
    double epsilon = 1e-6;         ///< added to each luminance before its logarithm, > 0
    bool skip_black = false;       ///< leave pixels of luminance 0 out of the statistics
    bool skip_transparent = false; ///< leave pixels of alpha 0 out of the statistics
    /// Set the curve's parameter `white` to this percentile of the calibrated luminance: above 0 to
    /// 100, which is the maximum.
    std::optional<double> white_percentile;
    /// Of calibrate(): what is written instead of the picture, in R, G and B alike. "exposure": the
    /// factor that the colour is multiplied by; "mean": the mean that it follows from; "key": what
    /// that mean becomes. Empty: the picture.
    std::string show;
    /// The shot that the mean and the white are of, instead of the image. The mean is then of
    /// pixels with light, without an epsilon; a percentile below 100 is read from a histogram, by
    /// interpolation within half a stop.
    AdaptOptions adapt;
};

/// What was measured and chosen.
struct CalibrationSummary {
    double mean = 0;     ///< geometric mean of the luminance; 0 where none was needed
    double key = 0;      ///< the key that was used; 0 where none was
    double exposure = 0; ///< stops that brought the mean of the whole image to the key
    double white = 0;    ///< the measured white; 0 where it was not asked for
    double unit = 0;     ///< cd/m2 of a pixel value of 1; 0 where none was needed
    /// The exposure value of the camera at ISO 100, log2(100 N^2 / (S T)).
    std::optional<double> ev100;
    int64_t pixels = 0;  ///< pixels in the statistics
    std::string adapted; ///< "shot of frames 1 to 8"; empty: measured on the image
    std::vector<std::string> warnings, notes;
};

struct TonemapOptions {
    PixelOptions pixels; ///< layer and colour space
    CurveOptions curve;
    std::optional<ViewOptions> view; ///< instead of the curve
    CalibrationOptions calibration;
    /// The primaries that a curve works in and that the result has: "rec709", or "image" for the
    /// image's own, whose luminance weights are then used. Views always start from the image's own.
    std::string primaries = "rec709";
    /// Encoding of a curve's result: none (linear), srgb, gamma2.2, rec1886 (2.4), gamma2.6.
    std::string encode = "srgb";
    bool clamp = true; ///< clamp the result of a curve to [0,1]
    /// How a colour with a channel above 1 is clamped. "channel": each channel by itself, which
    /// turns its hue; "luminance": its luminance and hue stay, and it becomes whiter; "neutral":
    /// its hue stays, and it becomes darker; "hue": as "luminance" where it is nearly white, as
    /// "neutral" where it is saturated.
    std::string clip = "channel";
    bool unpremult = false; ///< divide colour by alpha before and multiply after
};

struct TonemapSummary {
    std::string layer, space;
    std::string curve; ///< name, "coeffs", or "display/view"
    std::map<std::string, double> parameters;
    std::string on; ///< "rgb", "luminance", "color"
    /// Of a curve from a file: "4096 rows of x 0 to 16, rising"; empty: it is of the registry.
    std::string table;
    CalibrationSummary calibration;
    int64_t nonfinite = 0; ///< pixels with NaN or Inf in R, G or B
    int64_t negative = 0;  ///< pixels with a negative component where the curve works
    std::vector<std::string> warnings;
};

/// A tone curve of the registry, for people and for programs that show a menu.
struct ToneCurveParameter {
    std::string name, help;
    double value = 0, low = 0, high = 0;
    double flip_value = 0;    ///< the default in HDR-FLIP
    bool per_channel = false; ///< R, G and B may have values of their own
};
struct ToneCurveInfo {
    std::string name, title, source, formula, note;
    std::string domain;   ///< "rgb", "luminance" or "color"
    bool encoded = false; ///< the published formula's display-encoded result is decoded
    std::vector<ToneCurveParameter> parameters;
    std::vector<double> coefficients; ///< with its default parameters; empty where it has none
};

namespace ToneAlgo {

/// Tone map the colour of an image, by a curve or by a view.
///
/// Colour: R, G, B of the layer that options choose; every other channel is carried unchanged. For
///   a curve they are brought to linear light in `primaries`, multiplied by the calibrated
///   exposure, mapped, clamped and encoded; negative components become 0 and are counted. For a
///   view the configuration does everything, from the colour space that options.pixels.from names
///   (else the image's own) to the display's encoding; nothing is clamped.
/// NaN and -Inf become 0, +Inf the largest value; they are counted and warned about. Alpha:
/// associated colour is mapped as it is stored, as OpenColorIO's tools do; with unpremult it is
/// divided by alpha first where alpha is not 0. Statistics skip non-finite pixels, and cover the
/// whole data window whatever the ROI. The result is float and tagged with its colour space.
/// Errors: no colour, deep images, unknown names and values out of range, each with what would be
/// valid.
TONETOOL_API bool tonemap(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src,
                          const TonemapOptions& options = {}, TonemapSummary* summary = nullptr,
                          OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API OIIO::ImageBuf tonemap(const OIIO::ImageBuf& src, const TonemapOptions& options = {},
                                    TonemapSummary* summary = nullptr, OIIO::ROI roi = {},
                                    int nthreads = 0);

/// Calibration alone: multiply the colour by the exposure that is found. The image must be linear.
/// Non-finite pixels stay as they are.
TONETOOL_API bool calibrate(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src,
                            const CalibrationOptions& calibration = {},
                            const PixelOptions& options = {}, CalibrationSummary* summary = nullptr,
                            OIIO::ROI roi = {}, int nthreads = 0);

/// The registry of tone curves.
TONETOOL_API std::vector<ToneCurveInfo> tone_curves();
TONETOOL_API std::vector<std::string> tone_curve_names();

/// A curve from a file as tone_curves() shows those of the registry: its note says how many rows it
/// has, over which light, and whether it rises.
TONETOOL_API bool tone_curve_of_file(ToneCurveInfo& info, const CurveOptions& curve,
                                     std::string& error);

/// Display light of a grey of each of these exposed values, as the curve gives it, unclamped; the
/// mean where R, G and B have curves of their own.
TONETOOL_API bool tone_curve_response(std::vector<double>& response, const CurveOptions& curve,
                                      const std::vector<double>& values, std::string& error);

/// Encodings of `TonemapOptions::encode`.
TONETOOL_API std::vector<std::string> display_encodings();

/// The files that an OpenColorIO configuration refers to (LUTs, CDLs), on which its results depend.
/// Where a file name contains a context variable, which commands may set, these are all files of
/// the search path. Returns false with a reason in `error` where the configuration cannot be read.
TONETOOL_API bool color_config_files(const std::string& config, std::vector<std::string>& files,
                                     std::string& error);

/// The files that a LUT refers to: the references of a CTF or CLF file, and the references of those
/// in turn.
TONETOOL_API std::vector<std::string> lut_references(const std::string& file);

} // namespace ToneAlgo
} // namespace tonetool
