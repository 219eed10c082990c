// SPDX-License-Identifier: BSD-3-Clause
// Noise or change? Whether two renders differ in their expected values, which HDR-FLIP cannot see
// behind their noise; and a limit of an error from renders of the approved version.
//
// Welch 1947; Efron, "Student's t under symmetry conditions", JASA 64, 1969; Hall, "On the removal
// of skewness by transformation", JRSS B 54, 1992; Benjamini and Hochberg, JRSS B 57, 1995;
// Schuirmann 1987 (equivalence); Jung, Hanika, Dachsbacher, "Detecting Bias in Monte Carlo
// Renderers using Welch's t-test", JCGT 9(2), 2020; Hahn and Meeker, "Statistical Intervals", 1991
// (tolerance limits).
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tonetool/bias_numbers.h"
#include "tonetool/compare.h"
#include "tonetool/export.h"

namespace tonetool {

/// The maps of bias_check().
inline constexpr const char* kBiasMaps[] = {"signed", "p", "rejected", "all"};

/// The pixels that do not count are 0 in all images, and no block has them.
struct BiasOptions : BiasTest, IgnoreOptions {
    PixelOptions pixels;                 ///< layer and colour space, for all images
    SizePolicy size = SizePolicy::Match; ///< for images with different display windows
    /// Two layers that hold images of independent halves of the samples, which a renderer has
    /// written side by side: each image counts as two seeds then. Empty: none.
    std::vector<std::string> halves;
    /// Which map: "signed": relative difference, half-width of its interval, confidence 1 - p, of
    /// the finest block that differs, else of a block of about 32x32 pixels; "p": log10 of the
    /// smallest p over the channels for blocks of about 16, 32 and 64 pixels; "rejected": how many
    /// of these scales differ in their means (-1: not tested), and in structure; "all": these eight
    /// channels.
    std::string map = kBiasMaps[0];
    /// A bound of memory as in PairOptions; the images of a side are read one after another, but
    /// not in scanline blocks: a bound that is too small is an error. 0: no bound.
    uint64_t memory = 0;
};

/// How a side's images were read; counts are sums over them.
struct BiasSummary {
    BiasResult result;
    FlipSide reference, test;
    OIIO::ROI region; ///< pixels compared
    /// The part of them that does not count; unset: neither a mask nor a region was given.
    std::optional<double> ignored;
    /// Warnings for the user, one sentence each.
    std::vector<std::string> warnings;
};

namespace ToneAlgo {

/// Tells a change of a render from its noise. One or more images (seeds) a side: renders of the
/// same frame with different random numbers, without a denoiser. Three verdicts: Different, beyond
/// chance at level alpha; Equal, within the margin `within`, which the data show; NotEnoughSamples,
/// neither.
///
/// Tested are the signed differences of the means, in Y, R, G and B of linear Rec.709: of the whole
/// picture, and of blocks of about 16, 32 and 64 pixels; and whether differences have a structure.
/// A common error of both sides, one that a denoiser has smeared over its neighbours, and a single
/// firefly in a whole picture cannot be told.
///
/// Shapes: all images need R, G, B and the same display window (or `size`), and 4096 pixels or more
///   for a verdict; extra channels are ignored; deep images are an error. The union of the data
///   windows is compared; the map has that data window and float channels named as above
///   ("difference", "halfwidth", "confidence"; "p16", "p32", "p64"; "means", "structures").
/// Units: any, linear; differences are relative to the reference's light. Negative components stay.
/// Alpha: not compared.
/// NaN, Inf: such a pixel counts as 0 in all images; they are counted, and there is no Equal.
/// Identical images are Equal. The result does not depend on nthreads to the bit. Memory: 13 bytes
///   per pixel for a side of one image, 66 for one of several, whatever their number.
/// Seeds of one side that are the same image, or that differ from each other in more than their
///   noise (two versions were mixed), are an error, and so are NaN and Inf in more than 1 % of the
///   pixels.
/// Returns false, with the reason in dst.geterror(), and then never leaves a map in dst.
TONETOOL_API bool bias_check(OIIO::ImageBuf& dst,
                             const std::vector<const OIIO::ImageBuf*>& references,
                             const std::vector<const OIIO::ImageBuf*>& tests,
                             const BiasOptions& options = {}, BiasSummary* summary = nullptr,
                             int nthreads = 0);

/// "different", "equal", "not enough samples".
TONETOOL_API std::string bias_verdict_name(BiasVerdict verdict);
/// "evidence", "identical", "rounding", "means within", "differences within", "image too small",
/// "non-finite pixels", "correlated pixels", "undecided".
TONETOOL_API std::string bias_reason_name(BiasReason reason);
/// What was found, as "overall R", "mean 16: 3 of 144", "structure 32: 1 of 40"; for Equal: what is
/// real and still within the margin.
TONETOOL_API std::vector<std::string> bias_evidence(const BiasResult& result);
/// The middle of the finest block whose mean differs most, and by how much, as a part of the
/// reference's light; nothing where none differs.
struct BiasPlace {
    int x = 0, y = 0;
    double difference = 0;
};
TONETOOL_API std::optional<BiasPlace> bias_place(const BiasResult& result);
/// The verdict as a sentence that says what it means.
TONETOOL_API std::string bias_sentence(const BiasResult& result);
/// Every number of the result but those of single blocks, by its name; what was not computed is
/// left out.
TONETOOL_API std::vector<std::pair<std::string, double>> bias_numbers(const BiasResult& result);

/// The smallest upper tolerance limit: with `confidence`, at least the part `content` of the
/// distribution that `values` are from lies below it. Returns false and explains in `error` for
/// fewer than 4 values, values that are not finite, and a limit that cannot be exceeded.
TONETOOL_API bool noise_floor(NoiseFloor& floor, const std::vector<double>& values,
                              const NoiseFloorOptions& options, std::string& error);
/// "order statistic 59 of 59", "lognormal, k 4.3539".
TONETOOL_API std::string noise_floor_method(const NoiseFloor& floor);

} // namespace ToneAlgo
} // namespace tonetool
