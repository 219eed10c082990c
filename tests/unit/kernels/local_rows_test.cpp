// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/local_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hdr_image.h"
#include "target.h"

namespace tonetool::kernels {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Drago's curve in lanes and powers of 12 stops.
constexpr double kClose = 3e-6;

struct Pixels {
    std::vector<float> base, plane[3];

    void add(float b, float red, float green, float blue) {
        base.push_back(b);
        plane[0].push_back(red);
        plane[1].push_back(green);
        plane[2].push_back(blue);
    }
};

Pixels noise(size_t count) {
    Pixels out;
    Uniform random(1);
    const auto stops = [&] { return float(std::exp2(24 * random() - 12)); };
    for (size_t i = 0; i < count; ++i)
        out.add(stops(), stops(), stops(), stops());
    return out;
}

Pixels run(const LocalCurve& curve, Pixels p) {
    float* const at[3] = {p.plane[0].data(), p.plane[1].data(), p.plane[2].data()};
    local_rows(curve, p.base.data(), at, at, ptrdiff_t(p.base.size()));
    return p;
}

void expect_reference(const LocalCurve& curve, const Pixels& in) {
    const Pixels out = run(curve, in);
    for (size_t i = 0; i < in.base.size(); ++i) {
        const auto exact = local_reference(
            curve, double(in.base[i]),
            {double(in.plane[0][i]), double(in.plane[1][i]), double(in.plane[2][i])});
        for (size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(double(out.plane[c][i]), exact[c], kClose * std::abs(exact[c]) + 1e-37)
                << i << ": " << in.base[i] << ", " << in.plane[0][i] << " " << in.plane[1][i] << " "
                << in.plane[2][i];
    }
}

TEST(LocalRows, AreCloseToTheReferenceImplementation) {
    const Pixels in = noise(5003);
    for (double bias : {0.7, 0.85, 0.95})
        for (double maximum : {10.0, 1e4})
            for (double saturation : {1.0, 0.6, 1.5}) {
                LocalCurve curve;
                curve.adaptation = 0.3;
                curve.maximum = maximum;
                curve.bias = bias;
                curve.saturation = saturation;
                curve.display_maximum = 80;
                on_every_target([&] { expect_reference(curve, in); });
            }
}

TEST(LocalRows, TakeABaseOfLogarithms) {
    Pixels in = noise(500);
    LocalCurve curve;
    curve.maximum = 300;
    const Pixels linear = run(curve, in);
    for (float& b : in.base)
        b = std::log(b);
    curve.log_base = true;
    on_every_target([&] {
        expect_reference(curve, in);
        const Pixels out = run(curve, in);
        for (size_t i = 0; i < in.base.size(); ++i)
            EXPECT_NEAR(double(out.plane[1][i] / linear.plane[1][i]), 1, 1e-5);
    });
}

// Ld(Lmax) = Ld,max / 100 for every bias; the fixed points of section 1.1.
TEST(LocalRows, OfTheBaseItselfAreDragosCurve) {
    for (double bias : {0.5, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95})
        for (double display : {100.0, 250.0}) {
            LocalCurve curve;
            curve.adaptation = 0.2;
            curve.maximum = 37;
            curve.bias = bias;
            curve.display_maximum = display;
            Pixels in;
            in.add(37, 37, 37, 37);
            EXPECT_NEAR(double(run(curve, in).plane[0][0]), display / 100, 1e-6 * display / 100);
        }
    const double cases[][3] = {{10, 0.18, 0.09733},
                               {10, 1, 0.35096},
                               {10, 5, 0.79114},
                               {100, 1, 0.22293},
                               {1e4, 5, 0.37086}};
    for (const auto& c : cases) {
        LocalCurve curve;
        curve.maximum = c[0];
        Pixels in;
        const auto x = float(c[1]);
        in.add(x, x, x, x);
        EXPECT_NEAR(double(run(curve, in).plane[0][0]), c[2], 6e-6);
    }
}

TEST(LocalRows, GuardWhatIsNoLuminance) {
    LocalCurve curve;
    curve.maximum = 100;
    Pixels in;
    for (const float bad : {kNan, kInf, -kInf, -1.0f, 0.0f, 1e-42f})
        in.add(1, bad, bad, bad);
    in.add(1, kNan, 1, 1);
    const size_t black = in.base.size();
    for (const float base : {kNan, kInf, -2.0f, 0.0f, 1e-42f})
        in.add(base, 5, 5, 5);
    const Pixels global = [] {
        Pixels p;
        p.add(5, 5, 5, 5);
        return p;
    }();
    for (double saturation : {1.0, 0.5}) {
        curve.saturation = saturation;
        on_every_target([&] {
            const Pixels out = run(curve, in);
            for (size_t i = 0; i < out.base.size(); ++i)
                EXPECT_EQ(out.plane[0][i], i < black ? 0 : run(curve, global).plane[0][0]) << i;
        });
    }
}

TEST(LocalRows, KeepTheSignOfChannels) {
    LocalCurve curve;
    curve.maximum = 100;
    Pixels in;
    in.add(1, 2, 1, -0.5f);
    for (double saturation : {1.0, 0.5}) {
        curve.saturation = saturation;
        on_every_target([&] { expect_reference(curve, in); });
        EXPECT_LT(run(curve, in).plane[2][0], 0);
    }
}

TEST(LocalRows, KeepToTheirPixels) {
    const Pixels in = noise(70);
    LocalCurve curve;
    curve.maximum = 50;
    on_every_target([&] {
        const Pixels all = run(curve, in);
        for (size_t count = 0; count < 40; ++count) {
            Pixels out = in;
            float* const to[3] = {&out.plane[0][3], &out.plane[1][3], &out.plane[2][3]};
            const float* const from[3] = {&in.plane[0][3], &in.plane[1][3], &in.plane[2][3]};
            local_rows(curve, &in.base[3], from, to, ptrdiff_t(count));
            for (size_t i = 0; i < 70; ++i)
                ASSERT_EQ(out.plane[1][i],
                          i >= 3 && i < 3 + count ? all.plane[1][i] : in.plane[1][i]);
        }
    });
}

TEST(LogRows, AreLogarithms) {
    std::vector<float> in = {0, 1e-9f, 1e-6f, 0.5f, 1, 10, 1e30f, kNan, kInf, -1, -0.0f};
    on_every_target([&] {
        std::vector<float> out(in.size());
        log_rows(in.data(), out.data(), ptrdiff_t(in.size()), 1e-6f, float(std::log10(2.0)));
        for (size_t i = 0; i < in.size(); ++i)
            if (in[i] >= 0 && std::isfinite(in[i]))
                EXPECT_NEAR(double(out[i]), std::log10(std::max(double(in[i]), 1e-6)), 6e-6);
            else
                EXPECT_TRUE(std::isnan(out[i])) << in[i];
    });
}

TEST(LuminanceRows, AreWeightedSums) {
    const Pixels in = noise(37);
    const float* const at[3] = {in.plane[0].data(), in.plane[1].data(), in.plane[2].data()};
    on_every_target([&] {
        std::vector<float> out(37);
        luminance_rows({0.2, 0.7, 0.1}, at, out.data(), 37);
        for (size_t i = 0; i < 37; ++i) {
            const double exact =
                0.2 * double(at[0][i]) + 0.7 * double(at[1][i]) + 0.1 * double(at[2][i]);
            EXPECT_NEAR(double(out[i]), exact, 3e-7 * exact);
        }
    });
}

} // namespace
} // namespace tonetool::kernels
