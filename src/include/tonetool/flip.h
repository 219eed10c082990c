// SPDX-License-Identifier: BSD-3-Clause
// LDR-FLIP and HDR-FLIP: how different two images look, as a map and as numbers.
//
// P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild,
// "FLIP: A Difference Evaluator for Alternating Images", HPG 2020 (LDR-FLIP);
// P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Moller, "Visualizing Errors in Rendered
// High Dynamic Range Images", Eurographics 2021 (HDR-FLIP).
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/compare.h"
#include "tonetool/export.h"
#include "tonetool/tonemap.h"

namespace tonetool {

/// Options that LDR-FLIP and HDR-FLIP have in common.
struct FlipOptions : PairOptions {
    /// Pixels per degree of visual angle, 1 to 1000. Unset: computed from the three numbers below.
    std::optional<double> ppd;
    double distance = 0.7;       ///< viewing distance in metres, > 0
    double width = 0.7;          ///< width of the screen in metres, > 0
    double pixels_across = 3840; ///< width of the screen in pixels, > 0
};

/// HDR-FLIP: the exposures and the tone curve.
struct HdrFlipOptions : FlipOptions {
    /// The curve; its defaults are the paper's (aces with a prescale of 0.6). Six coefficients are
    /// applied per channel unless `on` says otherwise, and refused where the curve has a pole or
    /// does not increase between 0 and the largest exposed value of either image. A curve from a
    /// file must not fall for greys; exposures follow from the smallest light that it shows at
    /// 0.85, by the mean of its channels, and encoded values are those of sRGB.
    CurveOptions curve;
    /// Instead of the curve: an OpenColorIO view, so that what is compared is what a viewer sees on
    /// this display. The view gets linear Rec.709 and its result is brought to linear display light
    /// by the display's own colour space.
    std::optional<ViewOptions> view;
    /// How the view's result is encoded, where the display has no colour space that says so: srgb,
    /// gamma2.2, rec1886, gamma2.6, linear.
    std::string encoding;
    /// The luminance in cd/m2 that counts as the display's white. HDR displays are refused without
    /// it.
    std::optional<double> peak;
    /// Apply the view by per-pixel OpenColorIO. Else a 3D LUT is baked from the view, whose error
    /// on these images is measured; see FlipSummary.
    bool exact = false;
    std::optional<double> start_exposure;   ///< stops; unset: paper Eq. 2
    std::optional<double> stop_exposure;    ///< stops; unset: paper Eq. 3
    std::optional<int> num_exposures;       ///< 1 to 1024; unset: max(2, ceil(stop - start))
    std::optional<double> max_luminance;    ///< instead of measuring the reference's maximum
    std::optional<double> median_luminance; ///< instead of measuring the reference's median
    bool want_exposure_map = false;         ///< fill FlipResult::exposure_stops and exposure_index
    bool want_exposures = false;            ///< fill FlipResult::exposures
};

/// Everything that a reader needs to reproduce and trust the number.
struct FlipSummary : PairSummary {
    double ppd = 0;
    bool hdr = false;
    std::string tonemapper;                   ///< "aces", ..., "coeffs", or "display/view"
    std::map<std::string, double> parameters; ///< of the curve
    std::string on;             ///< "rgb", "luminance" or "color", what the curve is applied to
    std::vector<double> coeffs; ///< the six coefficients of the curve; empty where it has none
    /// Exposure anchor: the scene value of a grey that is shown at 0.85; 0: the curve has none.
    double bright = 0;
    /// The view was applied by a baked 3D LUT. The errors are its largest and mean |difference| to
    /// OpenColorIO, in display-linear light, over an evenly spaced sample of the exposed pixels of
    /// all images.
    bool baked = false;
    double bake_error_max = 0, bake_error_mean = 0;
    std::vector<double> exposures; ///< stops, ascending; empty for LDR-FLIP
    /// Luminances that gave the exposures, 0 if not used.
    double max_luminance = 0, median_luminance = 0;
    bool median_of_lit = false; ///< more than half the reference is black: median of the rest
};

/// One exposure of HDR-FLIP: the pair as it was compared and its LDR-FLIP map.
struct FlipExposure {
    double stops = 0;
    OIIO::ImageBuf reference, test; ///< 3 channels, tone mapped, display-linear Rec.709 in [0,1]
    OIIO::ImageBuf flip;            ///< 1 channel
};

struct FlipResult {
    FlipSummary summary;
    OIIO::ImageBuf exposure_stops; ///< 1 channel float: exposure of the largest error, in stops
    OIIO::ImageBuf exposure_index; ///< 1 channel float: its index 0 .. N-1
    std::vector<FlipExposure> exposures;
};

namespace ToneAlgo {

/// LDR-FLIP of `test` against `reference`: one float channel, 0 (same) to 1.
///
/// Shapes: both images need R, G, B; extra channels are ignored; deep images are an error. The
///   union of the data windows is compared (pixels outside an image's data window are black and
///   counted); the map has that data window and the reference's display window.
/// ROI: only these pixels are written (and pooled); neighbours are read from the whole image,
///   so that any tiling by ROIs gives the bits of one call. A `dst` that is initialized with one
///   float channel and covers the ROI is written in place, any other is allocated anew.
/// Colour: converted to linear Rec.709 by matrix, then clamped to [0,1]. Alpha: ignored unless
/// options.alpha says otherwise. NaN, Inf: a pixel that is non-finite in one image has error 1; in
/// both 0 where the two are alike (NaN, Inf and -Inf in the same components, the others equal),
/// else 1. Neighbours see the other image's pixel (black if both). Counted and warned about; if no
/// finite pixel is left the call fails. Orientation: images that differ in it are an error; images
/// turned alike are compared as stored. Identical images give exactly 0; the result does not depend
/// on nthreads to the bit. Memory: an ImageBuf that was opened with a file name and not read is
/// read from the file by the call itself, in scanline blocks where they are needed. Only the
/// channels that are compared are read, and nothing is put into an ImageCache (an image opened with
/// an IOProxy or a configuration must be read() first). A file that changes meanwhile is an error.
/// Counted against options.memory are: 105 MiB set aside for the program and OpenImageIO's shared
/// libraries; decoders; the results (the map 4 bytes per pixel, want_exposure_map 8, want_exposures
/// 28 per exposure, for each test); the scanline blocks; for SizePolicy::Resize the test image as a
/// whole. Not counted: pixels that the caller's ImageBufs hold, and decoders that hold the whole
/// image (JPEG 2000, WebP). A bound that is too small is an error that says what would do.
/// `result`, when given, receives the summary; the summary also lands in dst as `FLIP:*`. Returns
/// false, with the reason in dst.geterror(), and then never leaves a map in dst.
TONETOOL_API bool ldr_flip(OIIO::ImageBuf& dst, const OIIO::ImageBuf& reference,
                           const OIIO::ImageBuf& test, const FlipOptions& options = {},
                           FlipResult* result = nullptr, OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API OIIO::ImageBuf ldr_flip(const OIIO::ImageBuf& reference, const OIIO::ImageBuf& test,
                                     const FlipOptions& options = {}, FlipResult* result = nullptr,
                                     OIIO::ROI roi = {}, int nthreads = 0);

/// HDR-FLIP: the maximum of LDR-FLIP over N exposures of both images, each tone mapped.
///
/// As ldr_flip, except that only negative values are clamped before the tone map: they become 0 and
/// are counted. Exposures come from the compared region of the reference (whatever the ROI), its
/// finite pixels: start so that a grey of its maximum luminance, stop so that one of its median
/// luminance is shown at 0.85 (Eqs. 2, 3; the largest solution, found numerically where the curve
/// is not one of six coefficients); luminance is 0.2126 R + 0.7152 G + 0.0722 B. When more than
/// half of the reference is black, the median of its non-black pixels is taken and the summary says
/// so; an all-black reference needs explicit exposures. Where the error is 0 the exposure map holds
/// the start exposure (index 0).
TONETOOL_API bool hdr_flip(OIIO::ImageBuf& dst, const OIIO::ImageBuf& reference,
                           const OIIO::ImageBuf& test, const HdrFlipOptions& options = {},
                           FlipResult* result = nullptr, OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API OIIO::ImageBuf hdr_flip(const OIIO::ImageBuf& reference, const OIIO::ImageBuf& test,
                                     const HdrFlipOptions& options = {},
                                     FlipResult* result = nullptr, OIIO::ROI roi = {},
                                     int nthreads = 0);

/// HDR-FLIP of several tests against one reference, which is filtered only once: one map (and one
/// result, if asked for) per test, the same bits as one call each. All or nothing: on failure every
/// map (there is at least one) carries the error. A null pointer or no test is an error.
TONETOOL_API bool hdr_flip(std::vector<OIIO::ImageBuf>& dst, const OIIO::ImageBuf& reference,
                           const std::vector<const OIIO::ImageBuf*>& tests,
                           const HdrFlipOptions& options = {},
                           std::vector<FlipResult>* results = nullptr, OIIO::ROI roi = {},
                           int nthreads = 0);

/// The pair as hdr_flip compares it, without the comparison: FlipExposure::reference and test at
/// each of these exposures in stops, -126 to 127, in the order given; none: at the exposures that
/// hdr_flip would choose. They are, to the bit, those of FlipResult::exposures; `flip` is empty.
/// An image alone is its own reference.
///
/// Shapes, ROI, orientation, memory (24 bytes per pixel and exposure): as hdr_flip. Colour: linear
/// Rec.709, negative values 0, exposed by 2^stops, then behind the curve or view that `options`
/// choose: display-linear Rec.709 in [0,1]. Alpha: not in the images. NaN, Inf: a pixel that is
/// non-finite in one image shows the other's colour, in both it is black. A baked view's error is
/// not measured. The want_ options are ignored, so are the options of exposures where stops are
/// given. Returns false with the reason in `error`, as hdr_flip; `dst` is then empty.
TONETOOL_API bool flip_exposed(std::vector<FlipExposure>& dst, const OIIO::ImageBuf& reference,
                               const OIIO::ImageBuf& test, std::string& error,
                               const HdrFlipOptions& options = {},
                               const std::vector<double>& stops = {}, OIIO::ROI roi = {},
                               int nthreads = 0);

/// The names of the tone curves that HDR-FLIP takes: all of the registry.
TONETOOL_API std::vector<std::string> flip_tonemappers();

/// A quantity of the summary by name: mean, weighted-median, weighted-q1, weighted-q3, p50, p95,
/// p99, p99.9, min, max, and what PairOptions::quantities asked for; nullopt for any other name.
TONETOOL_API std::optional<double> flip_quantity(const FlipPool& pool, const std::string& name);
TONETOOL_API std::vector<std::string> flip_quantities();
/// The name of a quantity as the summary has it: "p99.9" for "p99.90"; nullopt for what is neither
/// one of flip_quantities() nor a percentile ("p99.95") nor a share ("above0.2").
TONETOOL_API std::optional<std::string> flip_quantity_name(const std::string& name);

/// The layout of the filmstrip.
struct FilmstripOptions {
    int thumb_width = 240; ///< width of one thumbnail in pixels, 32 to 4096
    int max_columns = 9;   ///< at most this many exposures are shown, evenly chosen, >= 1
    std::string font;      ///< font file; empty: DejaVu Sans where it is installed
};

/// The paper's Figure 1 as one image: a column per exposure (reference, test, LDR-FLIP), at the
/// right HDR-FLIP (magma) and the exposure map (viridis), labelled in stops. dst: 3 channels,
/// sRGB-encoded. Errors as hdr_flip. A missing font leaves the labels out and adds a warning to the
/// summary.
TONETOOL_API bool flip_filmstrip(OIIO::ImageBuf& dst, const OIIO::ImageBuf& reference,
                                 const OIIO::ImageBuf& test, const HdrFlipOptions& options = {},
                                 const FilmstripOptions& look = {}, FlipResult* result = nullptr,
                                 int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
