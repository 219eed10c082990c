// SPDX-License-Identifier: BSD-3-Clause
// Options of LDR-FLIP and HDR-FLIP to numbers, each checked once.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "flip/exposures.h"
#include "flip/filters.h"
#include "imagebuf/compare/flip_plan.h"
#include "imagebuf/compare/quantities.h"
#include "imagebuf/options/flip_options.h"
#include "kernels/curve_reference.h"
#include "kernels/curve_rows.h"
#include "metrics/refusal.h"
#include "tonemap/rational.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

void plan_common(const FlipOptions& options, FlipPlan& plan) {
    plan.common = options;
    plan_pool(options.quantities, plan.pool);
    FlipOptions screen;
    screen.ppd = options.ppd;
    check_options(options.ppd ? screen : options); // with ppd the others have no say
    plan.ppd = options.ppd ? *options.ppd
                           : flip::pixels_per_degree(options.distance, options.width,
                                                     options.pixels_across);
    if (!(plan.ppd >= kPpdRange.low && plan.ppd <= kPpdRange.high))
        throw Refusal(format("ppd is {} by distance, width and pixels: must be {} to {} pixels per "
                             "degree",
                             plan.ppd, kPpdRange.low, kPpdRange.high));
    plan.evaluation.taps = flip::lane_taps(flip::make_taps(plan.ppd));
}

// A quotient does not change when all six are scaled; lanes square large values in float.
std::array<double, 6> scaled(const std::vector<double>& coeffs) {
    std::array<double, 6> k{};
    std::copy_n(coeffs.begin(), 6, k.begin());
    double largest = 0;
    for (double v : k)
        largest = std::max(largest, std::abs(v));
    if (largest > 1e3 || largest < 1e-3)
        for (double& v : k)
            v /= largest;
    return k;
}

// x / (1 + x) on luminance, which the kernels of HDR-FLIP know.
bool is_reinhard(const CurvePlan& curve) {
    return curve.coeffs() == std::vector<double>{0, 1, 0, 0, 1, 1} && curve.on == "luminance" &&
           curve.use.saturation == 1;
}

// The smallest light that is shown bright; of the curves of the registry it is the largest.
std::optional<double> bright_of_table(const CurvePlan& curve) {
    if (curve.table->falls_at)
        throw Refusal(format("curve \"{}\" falls at x = {:g}: HDR-FLIP needs one that rises",
                             curve.name, *curve.table->falls_at));
    return tonemap::first_reach(curve.numbers, flip::kAnchorValue);
}

// Few curves are run by the kernels themselves; the others come to them as rows.
void show_through(const CurvePlan& curve, FlipPlan& plan) {
    flip::Evaluation& evaluation = plan.evaluation;
    const auto coeffs = curve.coeffs();
    if (curve.table) {
        plan.bright = bright_of_table(curve);
    } else if (coeffs.empty()) {
        plan.bright = flip::exposure_anchor([&](const std::vector<double>& values) {
            std::vector<double> shown;
            for (double x : values)
                shown.push_back(kernels::curve_reference(curve.numbers, x));
            return shown;
        });
    } else {
        evaluation.curve = {kernels::ToneKind::Rational, scaled(coeffs)};
        plan.bright = flip::exposure_anchor(evaluation.curve.k);
    }
    if (is_reinhard(curve))
        evaluation.curve.kind = kernels::ToneKind::ReinhardLuminance;
    else if (coeffs.empty() || curve.on != "rgb")
        evaluation.rows = [numbers = curve.numbers, use = curve.use](
                              const float* const in[3], float* const out[3], ptrdiff_t count,
                              float scale) { curve_rows(numbers, use, in, out, count, scale); };
}

void show_through_view(const HdrFlipOptions& options, FlipPlan& plan) {
    plan.light.open({*options.view, options.encoding, options.peak, options.pixels.from});
    plan.common.pixels.config = config_file(*options.view);
    plan.common.pixels.context = options.view->context;
    plan.tonemapper = plan.light.name();
    plan.evaluation.rows = options.exact ? plan.light.exact() : plan.light.baked();
    plan.bright = flip::exposure_anchor(
        [&](const std::vector<double>& values) { return plan.light.greys(values); });
}

void plan_tone(const HdrFlipOptions& options, FlipPlan& plan) {
    if (options.view) {
        show_through_view(options, plan);
        return;
    }
    if (!options.encoding.empty() || options.peak || options.exact)
        throw Refusal("encoding, peak and exact are of views: they need a display and a view");
    plan.curve = plan_curve(options.curve, true);
    plan.tonemapper = plan.curve.name;
    show_through(plan.curve, plan);
}

bool needs_max(const HdrFlipOptions& o) {
    return !o.start_exposure;
}

bool needs_median(const HdrFlipOptions& o) {
    return !o.stop_exposure && o.num_exposures != 1;
}

// Exposures that follow from the images need a grey that is shown bright.
void check_bright(const FlipPlan& plan) {
    const HdrFlipOptions& o = plan.hdr_options;
    if (plan.curve.table && !plan.bright && (needs_max(o) || needs_median(o)))
        throw Refusal(
            format("curve \"{}\" makes of greys at most {:g}{}, so there is no automatic "
                   "exposure: it must reach {} above x = 0, or pass startExposure and "
                   "stopExposure",
                   plan.curve.name, plan.curve.table->largest,
                   plan.curve.table->largest < flip::kAnchorValue ? "" : ", also of black",
                   flip::kAnchorValue));
}

} // namespace

FlipPlan plan_ldr(const FlipOptions& options) {
    FlipPlan plan;
    plan.evaluation.stops = {0.0};
    plan_common(options, plan);
    return plan;
}

FlipPlan plan_hdr(const HdrFlipOptions& options) {
    FlipPlan plan;
    plan.hdr = true;
    plan.hdr_options = options;
    plan_common(options, plan);
    plan_tone(options, plan);
    check_options(options);
    check_bright(plan);
    return plan;
}

FlipPlan plan_errors(const ErrorOptions& options, const metrics::PixelError& pixel_error,
                     bool exposed) {
    HdrFlipOptions all;
    static_cast<PairOptions&>(all) = options;
    all.start_exposure = options.start_exposure;
    all.stop_exposure = options.stop_exposure;
    all.num_exposures = options.num_exposures;
    FlipPlan plan = exposed ? plan_hdr(all) : plan_ldr(all);
    plan.pixel_error = pixel_error;
    return plan;
}

FlipPlan plan_shown(const HdrFlipOptions& options, const std::vector<double>& stops) {
    HdrFlipOptions all = options;
    all.want_exposures = true;
    all.want_exposure_map = false;
    if (!stops.empty()) { // they have the say, not the options
        all.start_exposure = all.stop_exposure = all.max_luminance = all.median_luminance = {};
        all.num_exposures = {};
    }
    FlipPlan plan = plan_hdr(all);
    plan.only_shown = true;
    for (double exposure : stops)
        if (!(exposure >= kStopsRange.low && exposure <= kStopsRange.high))
            throw Refusal(format("an exposure is {} stops: must be {} to {}", exposure,
                                 kStopsRange.low, kStopsRange.high));
    plan.evaluation.stops = stops;
    return plan;
}

bool needs_luminance(const FlipPlan& plan) {
    const HdrFlipOptions& o = plan.hdr_options;
    return plan.evaluation.stops.empty() &&
           ((needs_max(o) && !o.max_luminance) || (needs_median(o) && !o.median_luminance));
}

Exposures choose_exposures(const FlipPlan& plan, const metrics::ExposureStats& stats) {
    Exposures exposures;
    exposures.stops = plan.evaluation.stops;
    if (!exposures.stops.empty())
        return exposures;
    const HdrFlipOptions& o = plan.hdr_options;
    const bool need_max = needs_max(o), need_median = needs_median(o);
    double maximum = o.max_luminance.value_or(0), median = o.median_luminance.value_or(0);
    if (needs_luminance(plan)) {
        if (stats.max <= 0)
            throw Refusal("the reference is black (no pixel has positive light), so its exposures "
                          "cannot be measured: pass startExposure and stopExposure (or "
                          "maxluminance and medianluminance)");
        exposures.median_of_lit = need_median && !o.median_luminance && stats.median <= 0;
        maximum = o.max_luminance.value_or(stats.max);
        median =
            o.median_luminance.value_or(exposures.median_of_lit ? stats.median_lit : stats.median);
    }
    exposures.max_luminance = need_max ? maximum : 0;
    exposures.median_luminance = need_median ? median : 0;
    exposures.stops = flip::make_exposures(
        plan.bright, {o.start_exposure, o.stop_exposure, o.num_exposures, maximum, median});
    return exposures;
}

void check_curve(const FlipPlan& plan, const Exposures& exposures, double largest) {
    const std::vector<double>& coeffs = plan.hdr_options.curve.coeffs;
    if (!plan.hdr || plan.hdr_options.view || !is_rational(plan.hdr_options.curve))
        return;
    const double stops = *std::max_element(exposures.stops.begin(), exposures.stops.end());
    const double exposed = std::min(largest * std::exp2(stops), double(kernels::kLargestExposed));
    const std::string fault = tonemap::curve_fault(plan.evaluation.curve.k, exposed);
    if (!fault.empty())
        throw Refusal("coeffs " + OIIO::Strutil::join(coeffs, ",") + ": " + fault);
}

} // namespace tonetool
