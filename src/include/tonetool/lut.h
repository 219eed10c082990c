// SPDX-License-Identifier: BSD-3-Clause
// Tone curves and views as look-up tables for other programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/tonemap.h"

namespace tonetool {

struct LutOptions {
    CurveOptions curve;
    std::optional<ViewOptions> view; ///< instead of the curve
    /// Colour space of the configuration that a view starts from; empty: linear Rec.709, where
    /// curves always start.
    std::string from;
    std::string encode = "srgb"; ///< encoding of a curve's result, see display_encodings()
    /// The shaper that brings scene light x to 0 to 1. Programs must apply it before .cube, .spi1d
    /// and .spi3d; .clf and .ctf contain it. "log2": (log2(x + 2^min) - min) / (log2(2^max + 2^min)
    /// - min), which keeps 0 at 0; "acescct": the curve of S-2016-001 up to 1, x = 222.86;
    /// "linear": x, up to 1.
    std::string shaper = "log2";
    double min = -12, max = 10; ///< stops, of log2; -24 to 0 and 1 to 16
    /// Entries, or nodes along an edge of a cube; 0: 4096 or 33. 2 to 65536, 2 to 129.
    int size = 0;
    /// Of .acv: the scene light of the code value 255. 0: the curve's parameter `white`, or 1 where
    /// it has none.
    double white = 0;
};

/// What was written, and how far it is from the exact curve or view.
struct LutSummary {
    std::string format;       ///< "cube", "spi1d", "spi3d", "clf", "ctf", "acv"
    std::string structure;    ///< "1D 4096", "3D 33"; of clf and ctf also what is around it
    std::string input;        ///< the input that the file expects: space and shaper
    double low = 0, high = 0; ///< the scene light that the table covers and was measured over
    /// Largest and mean difference of the table's results, read with linear (cubes: the worse of
    /// trilinear and tetrahedral) interpolation by OpenColorIO. Code values.
    double max_error = 0, mean_error = 0;
    double grey_max_error = 0; ///< the same for greys alone
    int64_t samples = 0;
    std::vector<std::string> remarks; ///< what the format does not hold
};

namespace ToneAlgo {

/// Writes a curve or a view as a look-up table; the format is that of the extension: .cube, .spi1d,
/// .spi3d, .clf, .ctf, .acv.
///
/// Input is scene light in linear Rec.709 (views: `from`), negative values count as 0; the result
///   of a curve is clamped to [0,1] and encoded, that of a view is the display's.
/// .cube holds one table per channel where the curve is one per channel, else a cube; .spi1d can
///   only be the former: of a curve on luminance it is the response of greys, which a remark says.
///   .clf and .ctf take scene light itself: per channel a shaper and a table; curves that mix
///   channels by matrices keep these; .ctf, which only OpenColorIO reads, keeps the structure of
///   curves on luminance too. Everything else is written as a shaper and a cube.
/// .acv are the curves of Photoshop, of up to 16 points each, on pictures that are sRGB: a code
/// value
///   is decoded, multiplied by `white`, goes through the curve and is encoded. Shaper and size do
///   not apply; errors are those of the natural cubic spline through the points.
/// Written beside the target and renamed. Errors: unknown names, values out of range, a format that
/// cannot hold the curve; `error` says what would be valid.
TONETOOL_API bool export_lut(const std::string& filename, const LutOptions& options,
                             LutSummary* summary, std::string& error);

TONETOOL_API std::vector<std::string> lut_shapers();
TONETOOL_API std::vector<std::string> lut_formats();

} // namespace ToneAlgo
} // namespace tonetool
