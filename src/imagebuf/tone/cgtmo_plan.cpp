// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/tone/cgtmo_plan.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/options/cgtmo_options.h"
#include "imagebuf/options/shot_options.h"
#include "imagebuf/options/tone_options.h"
#include "imagebuf/pixels/names.h"
#include "imagebuf/tone/shot_statistics.h"
#include "metrics/refusal.h"
#include "tonemap/poisson.h"
#include "tonetool/tonemap.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

// As the authors' programs have it: 2.5 sigma to each side.
constexpr double kWindowOfSigma = 2.5;

// The place of a name among the choices of its option, which enumerators follow.
template <class Enum>
Enum chosen(const CgTmoOptions& o, const std::string CgTmoOptions::*member) {
    Enum found{};
    describe(o, [&](const auto& row) {
        if constexpr (std::is_same_v<std::decay_t<decltype(row.member)>,
                                     std::string CgTmoOptions::*>)
            if (row.member == member)
                found =
                    Enum(std::find(row.list.begin(), row.list.end(), o.*member) - row.list.begin());
    });
    return found;
}

// What a preset has for options that are unset.
struct Preset {
    const char* name;
    const char *domain, *base, *clip;
    double lumsigma;
    int samples;
    const char *count, *lwa, *maximum;
    double max_percentile;
};
constexpr Preset kPresets[] = {
    {"default", "log", "edges", "hue", kLuminanceSigma, 80, "lit", "cells", "auto", 99.99},
    {"paper", "linear", "mean", "channel", 0, 0, "all", "geometric", "first", 100},
    {"classic", "log", "mean", "channel", kLuminanceSigma, 80, "all", "geometric", "first", 100}};

void check_edges(const CgTmoOptions& o) {
    const bool edges = o.base == "edges";
    if (edges && o.filter != "guided")
        throw Refusal(format("base=edges is of filter=guided, and this is filter={}", o.filter));
    if (edges && o.domain != "log")
        throw Refusal("base=edges is made of logarithms: domain=linear needs base=mean");
    if (edges && o.lumsigma.value_or(0) != 0)
        throw Refusal("base=edges has no luminance term: lumsigma needs base=mean");
    const std::pair<const char*, bool> of_edges[] = {{"edge", o.edge.has_value()},
                                                     {"denoise", o.denoise.has_value()},
                                                     {"noise", !o.noise.empty()},
                                                     {"show=share", o.show == "share"},
                                                     {"steady=1", o.steady}};
    for (const auto& [name, given] : of_edges)
        if (given && !edges)
            throw Refusal(o.filter == "guided"
                              ? format("{} is of base=edges, and this is base=mean (valid: "
                                       "base=edges, preset=default)",
                                       name)
                              : format("{} is of filter=guided with base=edges, and this is "
                                       "filter={}",
                                       name, o.filter));
    if (!o.motion.empty() && !o.steady)
        throw Refusal("motion is of steady=1, which is not on");
}

void plan_wls(const CgTmoOptions& o, tonemap::WlsTerms& wls) {
    const std::pair<const char*, const std::optional<double>&> given[] = {
        {"wlsalpha", o.wlsalpha}, {"wlslambda", o.wlslambda}};
    for (const auto& [name, value] : given)
        if (value && o.filter != "wls")
            throw Refusal(format("{} is of filter=wls, and this is filter={}", name, o.filter));
    wls.alpha = o.wlsalpha.value_or(wls.alpha);
    wls.lambda = o.wlslambda.value_or(wls.lambda);
}

void plan_filter(const CgTmoOptions& o, LocalPlan& plan) {
    tonemap::LocalOperator& what = plan.what;
    if (o.base == "edges") {
        auto& edges = what.edges.emplace();
        edges.edge = o.edge.value_or(edges.edge);
        edges.denoise = o.denoise.value_or(edges.denoise);
    }
    what.luminance_sigma = *o.lumsigma;
    if (plan.filter == BaseFilter::Bilateral && what.luminance_sigma == 0)
        what.luminance_sigma = kLuminanceSigma;
    what.terms.position = o.sigma;
    plan.half = plan.filter == BaseFilter::None ? 0 : int(std::lround(kWindowOfSigma * o.sigma));
    const int window = (2 * plan.half + 1) * (2 * plan.half + 1);
    const bool whole = *o.samples == 0 || *o.samples >= window;
    plan.samples = plan.filter == BaseFilter::Wls ? 0 : whole ? window : *o.samples;
    what.terms.in_steps = !whole;
}

} // namespace

CgTmoOptions with_preset(const CgTmoOptions& options) {
    check_options(options);
    check_options(options.lights);
    check_options(options.adapt);
    CgTmoOptions o = options;
    if (o.method == "camera" && !o.lwa.empty())
        throw Refusal("lwa and method=camera both say what the adaptation luminance is: say one");
    if (o.preset.empty())
        o.preset = o.filter == "guided" ? "default" : "classic";
    const Preset& preset = *std::find_if(std::begin(kPresets), std::end(kPresets),
                                         [&](const Preset& p) { return o.preset == p.name; });
    const auto fill = [](std::string& value, const char* of_preset) {
        if (value.empty())
            value = of_preset;
    };
    fill(o.domain, preset.domain);
    fill(o.base, o.filter == "guided" && o.domain == "log" ? preset.base : "mean");
    fill(o.clip, preset.clip);
    check_edges(o);
    o.lumsigma = o.lumsigma.value_or(o.base == "edges" ? 0 : preset.lumsigma);
    o.samples = o.samples.value_or(preset.samples);
    fill(o.count, preset.count);
    if (o.method != "camera")
        fill(o.lwa, preset.lwa);
    fill(o.maximum, preset.maximum);
    o.max_percentile = o.max_percentile.value_or(preset.max_percentile);
    return o;
}

void check_steady(const CgTmoOptions& o) {
    if (o.steady && !adapts(o.adapt))
        throw Refusal("steady=1 is of the frames of a shot, and with adapt=frame each image is "
                      "alone (valid: adapt=shot, eye, smooth or FILE)");
}

LocalPlan plan_local(const CgTmoOptions& o) {
    LocalPlan plan;
    plan.encode = find_encoding(o.encode);
    if (!plan.encode)
        throw Refusal(unknown_name("encoding", o.encode, ToneAlgo::display_encodings()));
    const bool logarithmic = o.domain == "log";
    plan.filter = chosen<BaseFilter>(o, &CgTmoOptions::filter);
    plan.show = chosen<decltype(plan.show)>(o, &CgTmoOptions::show);
    plan.clip = chosen<decltype(plan.clip)>(o, &CgTmoOptions::clip);
    plan.what.terms.normal_term =
        chosen<decltype(plan.what.terms.normal_term)>(o, &CgTmoOptions::normaldist);
    plan_wls(o, plan.wls);
    plan.what.logarithmic = plan.wls.logarithmic = logarithmic;
    plan_filter(o, plan);
    plan.what.curve.bias = o.bias;
    plan.what.curve.display_maximum = o.ldmax;
    plan.what.curve.saturation = o.saturation;
    return plan;
}

kernels::TapSets taps_of(const LocalPlan& plan, double sigma) {
    // A mean of few samples shows where they change: it should not do so in columns. The other
    // bases keep the pictures that they made.
    const bool shows = plan.filter == BaseFilter::Guided && !plan.what.edges;
    if (plan.what.terms.in_steps)
        return {tonemap::poisson_sets(plan.half, plan.samples), sigma,
                shows ? kernels::RunOrigin::Hashed : kernels::RunOrigin::FirstColumn};
    return {{kernels::whole_window(plan.half)}, sigma};
}

} // namespace tonetool
