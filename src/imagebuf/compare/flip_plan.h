// SPDX-License-Identifier: BSD-3-Clause
// Options of LDR-FLIP and HDR-FLIP as the numbers the algorithm runs on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flip/evaluate.h"
#include "imagebuf/color/bake_error.h"
#include "imagebuf/color/curve_plan.h"
#include "imagebuf/color/view.h"
#include "imagebuf/pixels/planes.h"
#include "metrics/errors.h"
#include "metrics/luminance.h"
#include "metrics/pooling.h"
#include "tonetool/errors.h"
#include "tonetool/flip.h"

namespace tonetool {

/// Options after validation.
struct FlipPlan {
    FlipOptions common;
    HdrFlipOptions hdr_options; ///< only meaningful when hdr
    bool hdr = false;
    double ppd = 0;
    std::string tonemapper;                         ///< "aces", ..., "coeffs", or "display/view"
    CurvePlan curve;                                ///< unless there is a view,
    DisplayLight light;                             ///< which is this
    std::optional<double> bright;                   ///< scene value of a grey that is shown bright
    int band_rows = 0;                              ///< as in MemoryNeeds
    std::optional<metrics::PixelError> pixel_error; ///< instead of FLIP
    bool only_shown = false;                        ///< the exposed images alone, no map
    metrics::PoolRequest pool;                      ///< quantities beside the usual ones
    /// Where no stops are given, those of HDR-FLIP follow once the reference is read.
    flip::Evaluation evaluation;

    bool baked() const { return hdr_options.view && !hdr_options.exact; }
    bool filters() const { return !pixel_error && !only_shown; }
    bool alpha() const { return common.alpha == AlphaPolicy::Error; }
};

FlipPlan plan_ldr(const FlipOptions& options);
FlipPlan plan_hdr(const HdrFlipOptions& options);
/// `pixel_error` instead of FLIP, if `exposed` at the exposures that HDR-FLIP would take.
FlipPlan plan_errors(const ErrorOptions& options, const metrics::PixelError& pixel_error,
                     bool exposed);

/// HDR-FLIP's images without its map, at these stops; none: at the exposures that it would take.
FlipPlan plan_shown(const HdrFlipOptions& options, const std::vector<double>& stops);

/// The exposures of one comparison and what they were derived from.
struct Exposures {
    std::vector<double> stops;
    double max_luminance = 0, median_luminance = 0; ///< 0 where not used
    bool median_of_lit = false;
    BakeError bake; ///< of the table that a view is shown through
};

/// Whether the reference must be measured before its exposures are known.
bool needs_luminance(const FlipPlan& plan);

/// Exposures for a reference of these statistics, which are looked at only where they are needed:
/// not where the plan has stops already, as LDR-FLIP has stop 0.
Exposures choose_exposures(const FlipPlan& plan, const metrics::ExposureStats& stats);

/// A user's coefficients must be sound up to `largest`, the largest component of any image, at the
/// largest exposure.
void check_curve(const FlipPlan& plan, const Exposures& exposures, double largest);

} // namespace tonetool
