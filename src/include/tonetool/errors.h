// SPDX-License-Identifier: BSD-3-Clause
// Error maps by the metrics that rendering papers report.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/compare.h"
#include "tonetool/export.h"

namespace tonetool {

/// The metric and its parameters. With r a component (R, G, B) of the reference's pixel and t of
/// the test's, both linear Rec.709 >= 0, a pixel's error is the mean over its three components of
///
///   mae     |t - r|
///   mse     (t - r)^2
///   rmae    |t - r| / (r + eps)            relative to the reference, as the viewer tev shows it
///   relmse  (t - r)^2 / (r^2 + eps)        Rousselle, Knaus, Zwicker, "Adaptive Sampling and
///                                          Reconstruction using Greedy Error Minimization", 2011
///   smape   |t - r| / (r + t + eps)        Vogels et al., "Denoising with Kernel Prediction and
///                                          Asymmetric Loss Functions", 2018
///   psnr    (t - r)^2
///   mpsnr   the mean over N exposures c of (T(t, c) - T(r, c))^2 / 255^2, where T(x, c) is
///           255 (2^c x)^(1/2.2) clamped to [0,255] and rounded: the 8-bit photograph at c stops;
///           Munkberg, Clarberg, Hasselgren, Akenine-Moller, "High Dynamic Range Texture
///           Compression for Graphics Hardware", 2006
///
/// and the value for the whole image is the mean of the map; for psnr it is 10 log10(peak^2 / mean)
/// and for mpsnr 10 log10(1 / mean), in dB: infinite for equal images, higher is better. Munkberg
/// et al. choose the exposures by hand; here they are those of hdr_flip with the same reference.
struct ErrorOptions : PairOptions {
    std::string metric;                   ///< one of error_metrics()
    double eps = 0.01;                    ///< of rmae, relmse, smape: 1e-12 to 1e12
    double peak = 1;                      ///< of psnr: linear light, 1e-12 to 1e12
    std::optional<double> start_exposure; ///< of mpsnr: stops, as in HdrFlipOptions
    std::optional<double> stop_exposure;
    std::optional<int> num_exposures;
};

struct ErrorSummary : PairSummary {
    std::string metric;
    double value = 0;              ///< the metric's value for the whole image
    bool decibels = false;         ///< it is in dB, higher is better; else 0 is best
    double eps = 0;                ///< 0 where the metric has none
    double peak = 0;               ///< 0 where the metric has none
    std::vector<double> exposures; ///< of mpsnr: stops, ascending
    /// Luminances that gave the exposures, 0 if not used.
    double max_luminance = 0, median_luminance = 0;
    bool median_of_lit = false; ///< more than half the reference is black: median of the rest
};

namespace ToneAlgo {

/// The map of the error of `test` against `reference`: one float channel, >= 0; smape and mpsnr
/// are at most 1, the others have no bound (finite all the same: what is too large for a float is
/// the largest float).
///
/// Shapes, ROI, colour, alpha, memory: as ldr_flip in flip.h, except that no pixel depends on its
/// neighbours, and that only negative components are clamped: they become 0 and are counted. A
/// compared alpha joins the map as |difference|. NaN, Inf: a pixel that is non-finite in one image
/// counts as the largest error: 1 for smape and mpsnr; for the others the largest error of the
/// map's other pixels, or 1 if that is less. In both: 0 where they are alike, as in flip.h, else
/// the largest. Where the test alone is non-finite nothing bounds an error without a bound: its
/// mean, maximum, weighted quartiles, and the percentiles that reach these pixels are infinite, and
/// so is the value of the metric (psnr -Inf): no limit holds, and no test gains by it. Counted and
/// warned about; if no finite pixel is left the call fails. Identical images give exactly 0; the
/// result does not depend on nthreads to the bit: sums are in double and in a fixed order.
/// `summary`, when given, receives what was measured; it also lands in dst as
/// `Error:*`. Returns false, with the reason in dst.geterror(), and then never leaves a map in dst.
TONETOOL_API bool error_map(OIIO::ImageBuf& dst, const OIIO::ImageBuf& reference,
                            const OIIO::ImageBuf& test, const ErrorOptions& options,
                            ErrorSummary* summary = nullptr, OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API OIIO::ImageBuf error_map(const OIIO::ImageBuf& reference, const OIIO::ImageBuf& test,
                                      const ErrorOptions& options, ErrorSummary* summary = nullptr,
                                      OIIO::ROI roi = {}, int nthreads = 0);

/// smape, rmae, relmse, mse, mae, psnr, mpsnr.
TONETOOL_API std::vector<std::string> error_metrics();

} // namespace ToneAlgo
} // namespace tonetool
