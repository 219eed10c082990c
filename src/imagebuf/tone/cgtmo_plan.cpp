#include "imagebuf/tone/cgtmo_plan.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/names.h"
#include "tonemap/poisson.h"
#include "tonetool/tonemap.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

// As the authors' programs have it: 2.5 sigma to each side.
constexpr double kWindowOfSigma = 2.5;

// The place of a name in a list, which enumerators follow.
template <class Enum>
bool choose(const char* what, const std::string& name, const std::vector<std::string>& valid,
            Enum& out, std::string& error) {
    if (!one_of(what, name, valid, error))
        return false;
    out = Enum(std::find(valid.begin(), valid.end(), name) - valid.begin());
    return true;
}

bool check_numbers(const CgTmoOptions& o, std::string& error) {
    return in_range(o.sigma, 1, 20, "sigma", error) && in_range(o.bias, 0.01, 1, "bias", error) &&
           in_range(o.ldmax, 1, 10000, "ldmax", error) &&
           in_range(o.saturation, 0, 4, "saturation", error) &&
           in_range(o.lumsigma.value_or(0), 0, 10, "lumsigma", error) &&
           in_range(o.fov.value_or(90), 1, 179, "fov", error) &&
           (o.samples == 0 || in_range(o.samples, 4, 400, "samples", error));
}

bool plan_wls(const CgTmoOptions& o, tonemap::WlsTerms& wls, std::string& error) {
    const std::pair<const char*, const std::optional<double>&> given[] = {
        {"wlsalpha", o.wlsalpha}, {"wlslambda", o.wlslambda}};
    for (const auto& [name, value] : given)
        if (value && o.filter != "wls") {
            error = format("{} is of filter=wls, and this is filter={}", name, o.filter);
            return false;
        }
    wls.alpha = o.wlsalpha.value_or(wls.alpha);
    wls.lambda = o.wlslambda.value_or(wls.lambda);
    return in_range(wls.alpha, 0, 4, "wlsalpha", error) &&
           in_range(wls.lambda, 0, 100, "wlslambda", error);
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

bool plan_local(const CgTmoOptions& o, LocalPlan& plan, std::string& error) {
    plan = {};
    plan.encode = find_encoding(o.encode);
    if (!plan.encode) {
        error = unknown_name("encoding", o.encode, ToneAlgo::display_encodings());
        return false;
    }
    bool paper = false, logarithmic = false;
    if (!choose("preset", o.preset, {"default", "paper"}, paper, error))
        return false;
    const std::string domain = !o.domain.empty() ? o.domain : paper ? "linear" : "log";
    if (!choose("domain", domain, {"linear", "log"}, logarithmic, error) ||
        !choose("filter", o.filter, {"guided", "bilateral", "wls", "none"}, plan.filter, error) ||
        !choose("show", o.show, {"picture", "base", "detail"}, plan.show, error) ||
        !choose("normaldist", o.normaldist, {"euclid", "dot"}, plan.what.terms.normal_term,
                error) ||
        !check_numbers(o, error) || !plan_wls(o, plan.wls, error))
        return false;
    plan.what.logarithmic = plan.wls.logarithmic = logarithmic;
    plan_filter(o, paper, plan);
    plan.what.curve.bias = o.bias;
    plan.what.curve.display_maximum = o.ldmax;
    plan.what.curve.saturation = o.saturation;
    return true;
}

kernels::TapSets taps_of(const LocalPlan& plan, double sigma) {
    if (plan.what.terms.in_steps)
        return {tonemap::poisson_sets(plan.half, plan.samples), sigma};
    return {{kernels::whole_window(plan.half)}, sigma};
}

} // namespace tonetool
