#include "kernels/curve_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "curve_cases.h"
#include "kernels/curve_twin.h"
#include "kernels/tone_curve.h"
#include "target.h"

namespace tonetool::kernels {
namespace {

// Clamped to [0,1]. Where a result is not clamped the bound grows with it.
constexpr double kClose = 2e-6;

using Planes = std::array<std::vector<float>, 3>;

Planes greys() {
    const auto x = scene_values(12000);
    return {x, x, x};
}

// Saturated colours, dark and bright, in all orders of the channels.
Planes colors() {
    const auto x = scene_values(12001);
    Planes planes;
    for (size_t i = 0; i < x.size(); ++i) {
        planes[i % 3].push_back(x[i]);
        planes[(i + 1) % 3].push_back(x[i * 5477 % x.size()]);
        planes[(i + 2) % 3].push_back(x[i] * (i % 7 == 0 ? 0.0f : float(i % 100) * 0.011f));
    }
    return planes;
}

std::vector<CurveUse> uses(bool clamp) {
    std::vector<CurveUse> all(4);
    for (CurveUse& use : all)
        use.clamp = clamp;
    for (size_t i = 1; i < all.size(); ++i) {
        all[i].on_luminance = true;
        all[i].saturation = i == 1 ? 1.0 : i == 2 ? 0.5 : 2.0;
    }
    return all;
}

std::string name_of(const CurveUse& use) {
    return std::string(use.clamp ? "" : "unclamped ") +
           (use.on_luminance ? "luminance^" + std::to_string(use.saturation) : "channel");
}

using Exact = std::vector<std::array<double, 3>>;

Exact twin_of(const CurveNumbers& curve, const CurveUse& use, const Planes& in) {
    Exact out(in[0].size());
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = curve_twin(curve, use, {double(in[0][i]), double(in[1][i]), double(in[2][i])});
    return out;
}

Planes rows_of(const CurveNumbers& curve, const CurveUse& use, Planes planes, float scale = 1) {
    float* const at[3] = {planes[0].data(), planes[1].data(), planes[2].data()};
    curve_rows(curve, use, at, at, ptrdiff_t(planes[0].size()), scale);
    return planes;
}

struct Worst {
    double off = 0;
    size_t pixel = 0;
};

Worst worst_of(const Planes& ours, const Exact& exact) {
    Worst worst;
    for (size_t i = 0; i < exact.size(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            const double y = exact[i][c];
            const double off = std::abs(double(ours[c][i]) - y) / std::max(1.0, std::abs(y));
            if (!(off <= worst.off))
                worst = {off, i};
        }
    return worst;
}

// The worst over all targets.
double expect_close(const CurveCase& one, const CurveUse& use, const Planes& in) {
    double worst = 0;
    const Exact exact = twin_of(one.numbers, use, in);
    on_every_target([&] {
        const Worst here = worst_of(rows_of(one.numbers, use, in), exact);
        EXPECT_LE(here.off, kClose)
            << one.what << ", " << name_of(use) << ", at " << in[0][here.pixel] << " "
            << in[1][here.pixel] << " " << in[2][here.pixel];
        worst = std::max(worst, here.off);
    });
    return worst;
}

class CurveRows : public testing::TestWithParam<const tonemap::Curve*> {};

TEST_P(CurveRows, AreCloseToTheTwin) {
    double worst = 0;
    for (const CurveCase& one : cases_of(*GetParam()))
        for (const CurveUse& use : uses(true))
            for (const Planes& in : {greys(), colors()})
                worst = std::max(worst, expect_close(one, use, in));
    std::printf("  worst %.3g\n", worst);
}

TEST_P(CurveRows, AreCloseToTheTwinUnclamped) {
    double worst = 0;
    for (const CurveCase& one : cases_of(*GetParam()))
        for (const CurveUse& use : uses(false))
            for (const Planes& in : {greys(), colors()})
                worst = std::max(worst, expect_close(one, use, in));
    std::printf("  worst %.3g\n", worst);
}

INSTANTIATE_TEST_SUITE_P(Registry, CurveRows, testing::ValuesIn([] {
                             std::vector<const tonemap::Curve*> rows;
                             for (const auto& row : tonemap::all_curves())
                                 rows.push_back(&row);
                             return rows;
                         }()),
                         [](const auto& test) {
                             std::string name = test.param->name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

} // namespace
} // namespace tonetool::kernels
