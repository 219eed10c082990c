// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/tone/cgtmo_plan.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/options/cgtmo_options.h"
#include "imagebuf/options/tone_options.h"
#include "imagebuf/pixels/names.h"
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

void plan_wls(const CgTmoOptions& o, tonemap::WlsTerms& wls) {
    const std::pair<const char*, const std::optional<double>&> given[] = {
        {"wlsalpha", o.wlsalpha}, {"wlslambda", o.wlslambda}};
    for (const auto& [name, value] : given)
        if (value && o.filter != "wls")
            throw Refusal(format("{} is of filter=wls, and this is filter={}", name, o.filter));
    wls.alpha = o.wlsalpha.value_or(wls.alpha);
    wls.lambda = o.wlslambda.value_or(wls.lambda);
}

void plan_filter(const CgTmoOptions& o, bool paper, LocalPlan& plan) {
    tonemap::LocalOperator& what = plan.what;
    what.luminance_sigma = o.lumsigma.value_or(paper ? 0 : kLuminanceSigma);
    if (plan.filter == BaseFilter::Bilateral && what.luminance_sigma == 0)
        what.luminance_sigma = kLuminanceSigma;
    what.terms.position = o.sigma;
    plan.half = plan.filter == BaseFilter::None ? 0 : int(std::lround(kWindowOfSigma * o.sigma));
    const int window = (2 * plan.half + 1) * (2 * plan.half + 1);
    const bool whole = o.samples == 0 || o.samples >= window;
    plan.samples = plan.filter == BaseFilter::Wls ? 0 : whole ? window : o.samples;
    what.terms.in_steps = !whole;
}

} // namespace

LocalPlan plan_local(const CgTmoOptions& o) {
    check_options(o);
    check_options(o.lights);
    LocalPlan plan;
    plan.encode = find_encoding(o.encode);
    if (!plan.encode)
        throw Refusal(unknown_name("encoding", o.encode, ToneAlgo::display_encodings()));
    const bool paper = o.preset == "paper";
    const bool logarithmic = o.domain.empty() ? !paper : o.domain == "log";
    plan.filter = chosen<BaseFilter>(o, &CgTmoOptions::filter);
    plan.show = chosen<decltype(plan.show)>(o, &CgTmoOptions::show);
    plan.what.terms.normal_term =
        chosen<decltype(plan.what.terms.normal_term)>(o, &CgTmoOptions::normaldist);
    plan_wls(o, plan.wls);
    plan.what.logarithmic = plan.wls.logarithmic = logarithmic;
    plan_filter(o, paper, plan);
    plan.what.curve.bias = o.bias;
    plan.what.curve.display_maximum = o.ldmax;
    plan.what.curve.saturation = o.saturation;
    return plan;
}

kernels::TapSets taps_of(const LocalPlan& plan, double sigma) {
    if (plan.what.terms.in_steps)
        return {tonemap::poisson_sets(plan.half, plan.samples), sigma};
    return {{kernels::whole_window(plan.half)}, sigma};
}

} // namespace tonetool
