// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/curve_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "curve_cases.h"
#include "kernels/curve_reference.h"
#include "kernels/curve_table.h"
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

Exact reference_of(const CurveNumbers& curve, const CurveUse& use, const Planes& in) {
    Exact out(in[0].size());
    for (size_t i = 0; i < out.size(); ++i)
        out[i] =
            curve_reference(curve, use, {double(in[0][i]), double(in[1][i]), double(in[2][i])});
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
    const Exact exact = reference_of(one.numbers, use, in);
    on_every_target([&] {
        const Worst here = worst_of(rows_of(one.numbers, use, in), exact);
        EXPECT_LE(here.off, kClose)
            << one.what << ", " << name_of(use) << ", at " << in[0][here.pixel] << " "
            << in[1][here.pixel] << " " << in[2][here.pixel];
        worst = std::max(worst, here.off);
    });
    return worst;
}

double worst_of_all(const tonemap::Curve& curve, bool clamp) {
    double worst = 0;
    for (const CurveCase& one : cases_of(curve))
        for (const CurveUse& use : uses(clamp))
            for (const Planes& in : {greys(), colors()})
                worst = std::max(worst, expect_close(one, use, in));
    return worst;
}

class CurveRows : public testing::TestWithParam<const tonemap::Curve*> {};

TEST_P(CurveRows, AreCloseToTheReferenceImplementation) {
    std::printf("  worst %.3g\n", worst_of_all(*GetParam(), true));
}

TEST_P(CurveRows, AreCloseToTheReferenceImplementationUnclamped) {
    std::printf("  worst %.3g\n", worst_of_all(*GetParam(), false));
}

// Any count, at any place, in place or not: the same bits, and nothing beyond them touched.
TEST_P(CurveRows, KeepToTheirPixels) {
    const auto numbers = cases_of(*GetParam()).front().numbers;
    const Planes in = colors();
    constexpr size_t most = 67, before = 3;
    for (const CurveUse& use : uses(true))
        on_every_target([&] {
            const Planes all = rows_of(numbers, use, in);
            for (size_t count = 0; count <= most; ++count) {
                Planes out;
                for (auto& plane : out)
                    plane.assign(before + most + 1, -7.0f);
                const float* const from[3] = {&in[0][5], &in[1][5], &in[2][5]};
                float* const to[3] = {&out[0][before], &out[1][before], &out[2][before]};
                curve_rows(numbers, use, from, to, ptrdiff_t(count), 1);
                for (size_t c = 0; c < 3; ++c)
                    for (size_t i = 0; i < out[c].size(); ++i)
                        ASSERT_EQ(out[c][i], i >= before && i < before + count
                                                 ? all[c][5 + i - before]
                                                 : -7.0f)
                            << name_of(use) << ", " << count << " pixels, " << i;
            }
        });
}

TEST_P(CurveRows, ExposeFirst) {
    const auto numbers = cases_of(*GetParam()).front().numbers;
    Planes exposed = colors();
    for (auto& plane : exposed)
        for (float& x : plane)
            x *= 4;
    for (const CurveUse& use : uses(true))
        on_every_target(
            [&] { EXPECT_EQ(rows_of(numbers, use, colors(), 4), rows_of(numbers, use, exposed)); });
}

// Black, denormals, the largest floats, and one channel alone.
TEST_P(CurveRows, EndsOfTheRangeAreFinite) {
    const float tiny = std::numeric_limits<float>::denorm_min();
    const float least = std::numeric_limits<float>::min();
    const float most = std::numeric_limits<float>::max();
    const float ends[] = {0, tiny, 100 * tiny, least, 4 * least, 1e-30f, 1, 1e10f, 1e30f, most};
    Planes in;
    for (float r : ends)
        for (float g : ends)
            for (float b : ends) {
                in[0].push_back(r);
                in[1].push_back(g);
                in[2].push_back(b);
            }
    for (const CurveCase& one : cases_of(*GetParam())) {
        // On luminance, ratios of 1e-45 lose their digits.
        expect_close(one, uses(true).front(), in);
        for (const CurveUse& use : uses(false))
            on_every_target([&] {
                for (const auto& plane : rows_of(one.numbers, use, in))
                    for (float y : plane)
                        ASSERT_TRUE(std::isfinite(y)) << one.what << " " << name_of(use);
            });
    }
}

TEST_P(CurveRows, NoLuminanceIsBlack) {
    if (GetParam()->domain == tonemap::CurveDomain::Color)
        return; // never on luminance
    const auto numbers = cases_of(*GetParam()).front().numbers;
    const float tiny = std::numeric_limits<float>::denorm_min();
    const Planes in = {
        {{0, tiny, 1000 * tiny, 0, 0}, {0, tiny, 0, 0, tiny}, {0, tiny, 0, tiny, 0}}};
    for (CurveUse use : uses(false)) {
        if (!use.on_luminance)
            continue;
        on_every_target([&] {
            for (const auto& plane : rows_of(numbers, use, in))
                for (float y : plane)
                    EXPECT_EQ(y, 0) << name_of(use);
        });
    }
}

TEST(CurveRowsWeights, MayBeZero) {
    CurveUse use;
    use.on_luminance = true;
    use.weights = {1, 0, 0};
    const CurveNumbers linear{};
    const Planes in = {{{2e-38f, 0, 0.25f}, {1, 1, 0.5f}, {1e10f, 0, 0}}};
    for (double saturation : {1.0, 2.0, 0.5}) {
        use.saturation = saturation;
        on_every_target([&] {
            const Planes out = rows_of(linear, use, in);
            EXPECT_TRUE(std::isfinite(out[2][0]));
            EXPECT_EQ(out[1][1], 0) << "luminance is 0";
            EXPECT_NEAR(out[1][2], 0.25 * std::pow(2, saturation), 1e-6);
        });
    }
}

CurveNumbers table_of(size_t rows, bool log2) {
    TableRows table;
    table.log2 = log2;
    for (size_t i = 0; i < rows; ++i) {
        const double share = double(i) / double(rows - 1), bent = share * share;
        table.x.push_back(log2 ? 24 * share - 16 : 0.01 + 12 * bent);
        for (size_t c = 0; c < 3; ++c)
            table.y[c].push_back(std::pow(share, 1 + 0.5 * double(c)));
    }
    CurveNumbers numbers;
    numbers.kind = CurveKind::Table;
    numbers.table = std::make_shared<CurveTable>(std::move(table));
    return numbers;
}

// Any number of rows, not only powers of two, below, among and beyond them.
TEST(CurveRowsTable, AreCloseToTheReferenceImplementation) {
    for (size_t rows : {2, 3, 4, 5, 17, 256, 257, 65536})
        for (bool log2 : {false, true}) {
            const CurveCase one = {std::to_string(rows) + (log2 ? " rows, log2" : " rows"),
                                   table_of(rows, log2), true};
            for (const Planes& in : {greys(), colors()})
                for (const CurveUse& use : {CurveUse(), uses(true)[1]})
                    expect_close(one, use, in);
        }
}

// Rows that float does not tell apart are a step, never a NaN.
TEST(CurveRowsTable, HasStepsWhereRowsAreOneInFloat) {
    CurveNumbers numbers;
    numbers.kind = CurveKind::Table;
    const std::vector<double> y = {0, 0.25, 0.75, 1};
    numbers.table = std::make_shared<CurveTable>(TableRows{{0, 1, 1 + 1e-12, 2}, {y, y, y}, false});
    const Planes in = {{{0, 1, 1.5f, 2, 1e15f}, {0, 1, 1.5f, 2, 1e15f}, {0, 1, 1.5f, 2, 1e15f}}};
    on_every_target([&] {
        const Planes out = rows_of(numbers, CurveUse(), in);
        const float expected[] = {0, 0.75f, 0.875f, 1, 1};
        for (size_t i = 0; i < 5; ++i)
            EXPECT_NEAR(out[1][i], expected[i], 1e-6) << i;
    });
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
