#include "imagebuf/tone/cgtmo_plan.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"
#include "tonemap/poisson.h"
#include "tonetool/tonemap.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

// As the authors' programs have it: 2.5 sigma to each side.
constexpr double kWindowOfSigma = 2.5;

// The place of a name in a list, which enumerators follow.
template <class Enum>
void choose(const char* what, const std::string& name, const std::vector<std::string>& valid,
            Enum& out) {
    check_one_of(what, name, valid);
    out = Enum(std::find(valid.begin(), valid.end(), name) - valid.begin());
}

void check_numbers(const CgTmoOptions& o) {
    check_range(o.sigma, 1, 20, "sigma");
    check_range(o.bias, 0.01, 1, "bias");
    check_range(o.ldmax, 1, 10000, "ldmax");
    check_range(o.saturation, 0, 4, "saturation");
    check_range(o.lumsigma.value_or(0), 0, 10, "lumsigma");
    check_range(o.fov.value_or(90), 1, 179, "fov");
    if (o.samples != 0)
        check_range(o.samples, 4, 400, "samples");
}

void plan_wls(const CgTmoOptions& o, tonemap::WlsTerms& wls) {
    const std::pair<const char*, const std::optional<double>&> given[] = {
        {"wlsalpha", o.wlsalpha}, {"wlslambda", o.wlslambda}};
    for (const auto& [name, value] : given)
        if (value && o.filter != "wls")
            throw Refusal(format("{} is of filter=wls, and this is filter={}", name, o.filter));
    wls.alpha = o.wlsalpha.value_or(wls.alpha);
    wls.lambda = o.wlslambda.value_or(wls.lambda);
    check_range(wls.alpha, 0, 4, "wlsalpha");
    check_range(wls.lambda, 0, 100, "wlslambda");
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
    LocalPlan plan;
    plan.encode = find_encoding(o.encode);
    if (!plan.encode)
        throw Refusal(unknown_name("encoding", o.encode, ToneAlgo::display_encodings()));
    bool paper = false, logarithmic = false;
    choose("preset", o.preset, {"default", "paper"}, paper);
    const std::string domain = !o.domain.empty() ? o.domain : paper ? "linear" : "log";
    choose("domain", domain, {"linear", "log"}, logarithmic);
    choose("filter", o.filter, {"guided", "bilateral", "wls", "none"}, plan.filter);
    choose("show", o.show, {"picture", "base", "detail"}, plan.show);
    choose("normaldist", o.normaldist, {"euclid", "dot"}, plan.what.terms.normal_term);
    check_numbers(o);
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
