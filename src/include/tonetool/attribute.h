// SPDX-License-Identifier: BSD-3-Clause
// Whose error is it? The error of a pair by light groups, by objects and materials of Cryptomatte,
// and by the other layers that both images have.
//
// J. Friedman, A. C. Jones, "Fully automatic ID mattes with support for motion blur and
// transparency", SIGGRAPH 2015 Posters; Cryptomatte specification 1.2.0.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "tonetool/attribute_numbers.h"
#include "tonetool/errors.h"
#include "tonetool/export.h"
#include "tonetool/flip.h"

namespace tonetool {

/// Which error is attributed, and how far. `size` may not be Resize, `alpha` is not attributed,
/// `quantities` and the further images of HDR-FLIP are not made.
struct AttributeOptions : HdrFlipOptions {
    /// "hdrflip", "ldrflip", or one of error_metrics().
    std::string metric = "hdrflip";
    double eps = 0.01; ///< of rmae, relmse, smape, as ErrorOptions::eps
    /// Also measure what each light group does alone; else only what replacing it takes away, in
    /// half the time.
    bool alone = true;
};

namespace ToneAlgo {

/// Tells which lights, objects and layers the error of `test` against `reference` comes from. Each
/// image is given by all its parts (subimages). Needs only what is in both: light groups
/// (`<beauty>_<group>`), Cryptomatte 1.2.0 (with its manifest in the header or beside the file),
/// depth, position, normal, ids, albedo and other colours.
///
/// - Lights: each group's light is exchanged between the images, and the error measured again. A
///   finding needs the light itself: a gain off 1 by 5 % and by 6 standard errors, of a group with
///   a thousandth of the light. The error alone would blame the brightest light for its noise.
/// - Objects: the error under each, by its coverage; findings need 4 pixels (and 1 % of its area)
///   whose coverage changes by half, or 64 pixels whose colour does as a light's.
/// - Layers: a finding needs a thousandth of the pixels: depths that differ by more than 1 %,
///   positions by a thousandth of the scene's diagonal, normals by 10 degrees, ids at all.
///
/// `map`, when given, is the error of the pair: one channel, of the region to be looked at. Else it
/// is measured. Pixels that are not finite count in no gain. The result does not depend on nthreads
/// to the bit. Memory: all layers of both images that are used, as float, and 29 bytes per pixel
/// for each exchanged group, of which as many are measured at once as fit into options.memory (0:
/// 2 GiB).
///
/// Returns false with the reason in `error` where an image is deep or unreadable, the beauty cannot
/// be told, the display windows differ, or ids have been through half or a lossy compression.
TONETOOL_API bool attribute(AttributeResult& result,
                            const std::vector<const OIIO::ImageBuf*>& reference,
                            const std::vector<const OIIO::ImageBuf*>& test, std::string& error,
                            const AttributeOptions& options = {},
                            const OIIO::ImageBuf* map = nullptr, int nthreads = 0);

/// The findings as sentences, those of lights first: "light neonC: off, explains 52 % of the
/// error".
TONETOOL_API std::vector<std::string> attribute_findings(const AttributeResult& result);

} // namespace ToneAlgo
} // namespace tonetool
