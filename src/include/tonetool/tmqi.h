// SPDX-License-Identifier: BSD-3-Clause
// TMQI: how much of an HDR image its tone-mapped image shows, and how natural that looks.
//
// H. Yeganeh, Z. Wang, "Objective Quality Assessment of Tone-Mapped Images", IEEE Transactions on
// Image Processing 22(2), 2013; in detail as the authors' program in HDR Toolbox.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/compare.h"
#include "tonetool/export.h"

namespace tonetool {

struct TmqiOptions {
    PixelOptions hdr, ldr; ///< layer and colour space of each
    /// Compare only where the display windows overlap; else they must be the same.
    bool crop = false;
    /// A bound of memory as in PairOptions, but TMQI cannot work in scanline blocks: a bound that
    /// is too small is an error. 0: no bound.
    uint64_t memory = 0;
};

struct TmqiSummary {
    TmqiScore score;
    FlipSide hdr, ldr;
    OIIO::ROI region; ///< pixels compared
    /// Warnings for the user, one sentence each (non-finite pixels, pixels outside the data window,
    /// ...).
    std::vector<std::string> warnings;
};

namespace ToneAlgo {

/// The quality index of `ldr`, a tone-mapped image of `hdr`, and the map of its structural fidelity
/// at the finest scale: one float channel, 1 where the tone-mapped image keeps the local structure,
/// 0 where it is lost, -1 at the least.
///
/// Shapes: both images need R, G, B and 11x11 pixels; extra channels are ignored; deep images are
///   an error. The union of the data windows is compared, with `crop` only as far as it lies in
///   both display windows; the map has that data window.
/// hdr: luminance of linear Rec.709, negative components 0; its range is scaled to 32-bit integers,
///   so its unit does not matter. A constant image has no range and is an error.
/// ldr: 255 (0.2126 R + 0.7152 G + 0.0722 B) of the sRGB-encoded values, as a display is sent them:
///   an sRGB file's own numbers; a linear image is clamped to [0,1] and encoded.
/// Borders: the 11x11 Gaussian window (sigma 1.5) sees black beyond the image, and so do the 11x11
///   blocks of the naturalness, as in HDR Toolbox. Reference numbers of programs that keep the
///   window inside the image differ.
/// Variances are computed about the middle of the window, where HDR Toolbox subtracts squares of
///   32-bit numbers; a scale whose mean fidelity is negative makes s 0 instead of complex.
/// NaN, Inf: such a pixel, and one outside the data window, is black in that image (the HDR image's
///   darkest value); its structure at the finest scale is 0 unless both images have it. Counted and
///   warned about; if no finite pixel is left the call fails.
/// The result does not depend on nthreads to the bit. Memory: 17 bytes per pixel and some MB for
///   each thread; images that were not read are read from their files in bands.
/// `summary`, when given, receives the numbers; the score also lands in dst as `TMQI:*`.
/// Returns false, with the reason in dst.geterror(), and then never leaves a map in dst.
TONETOOL_API bool tmqi(OIIO::ImageBuf& dst, const OIIO::ImageBuf& hdr, const OIIO::ImageBuf& ldr,
                       const TmqiOptions& options = {}, TmqiSummary* summary = nullptr,
                       int nthreads = 0);
TONETOOL_API OIIO::ImageBuf tmqi(const OIIO::ImageBuf& hdr, const OIIO::ImageBuf& ldr,
                                 const TmqiOptions& options = {}, TmqiSummary* summary = nullptr,
                                 int nthreads = 0);

/// A number of the score by its name, Q, S or N; nullopt for any other name.
TONETOOL_API std::optional<double> tmqi_quantity(const TmqiScore& score, const std::string& name);
TONETOOL_API std::vector<std::string> tmqi_quantities();

} // namespace ToneAlgo
} // namespace tonetool
