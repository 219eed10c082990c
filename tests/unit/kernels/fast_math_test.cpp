// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fast_math_test.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/highway.h>

#include "kernels/fast_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<float> d{};

// `count` is a multiple of every vector length; what is exact is added up in double.
template <class Function>
void StoreRoots(const float* in, size_t count, double* out, const Function& cube_root) {
    float high[64], rest[64];
    for (size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto root = cube_root(hn::LoadU(d, in + i));
        hn::StoreU(root.high, d, high);
        hn::StoreU(root.rest, d, rest);
        for (size_t j = 0; j < hn::Lanes(d); ++j)
            out[i + j] = double(high[j]) * (1.0 + double(rest[j]));
    }
}

void CubeRoots(const float* in, size_t count, double* out) {
    StoreRoots(in, count, out, [](auto x) HWY_ATTR { return CubeRoot(d, x); });
}

void CubeRootsOfShares(const float* in, size_t count, double* out) {
    StoreRoots(in, count, out, [](auto x) HWY_ATTR { return CubeRootOfShare(d, x); });
}

template <class Function>
void Store(const float* in, size_t count, double* out, const Function& function) {
    float values[64];
    for (size_t i = 0; i < count; i += hn::Lanes(d)) {
        hn::StoreU(function(hn::LoadU(d, in + i)), d, values);
        for (size_t j = 0; j < hn::Lanes(d); ++j)
            out[i + j] = double(values[j]);
    }
}

void Logs(const float* in, size_t count, double* out) {
    Store(in, count, out, [](auto x) HWY_ATTR { return Log2(d, x); });
}

void LogsOfOnePlus(const float* in, size_t count, double* out) {
    Store(in, count, out, [](auto x) HWY_ATTR { return Log2OfOnePlus(d, x); });
}

void Powers(const float* in, size_t count, double* out) {
    Store(in, count, out, [](auto x) HWY_ATTR { return Exp2(d, x); });
}

void PowersLessOne(const float* in, size_t count, double* out) {
    Store(in, count, out, [](auto x) HWY_ATTR { return Exp2LessOne(d, x); });
}

int64_t Target() {
    return HWY_TARGET;
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {

HWY_EXPORT(CubeRoots);
HWY_EXPORT(CubeRootsOfShares);
HWY_EXPORT(Logs);
HWY_EXPORT(LogsOfOnePlus);
HWY_EXPORT(Powers);
HWY_EXPORT(PowersLessOne);
HWY_EXPORT(Target);

namespace {

constexpr size_t kCount = size_t(1) << 18; // a multiple of every vector length

// From `low` to `high`, evenly in the logarithm, both ends and the floats around 1 included.
std::vector<float> geometric(double low, double high) {
    std::vector<float> x(kCount);
    const double span = std::log2(high / low);
    for (size_t i = 0; i < kCount; ++i)
        x[i] = float(low * std::exp2(span * double(i) / double(kCount - 1)));
    x.front() = float(low);
    x.back() = float(high);
    for (size_t i = 0; i < 64; ++i)
        x[1000 + i] = float(1.0 + (double(i) - 32) * 5.960464477539063e-8); // 2^-24
    return x;
}

class FastMath : public testing::TestWithParam<int64_t> {
protected:
    void SetUp() override {
        hwy::SetSupportedTargetsForTest(GetParam());
        hwy::GetChosenTarget().Update(GetParam());
        ASSERT_EQ(HWY_DYNAMIC_DISPATCH(Target)(), GetParam());
    }
    void TearDown() override {
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

// The bounds are those the header promises.

// The largest relative error of cube roots, and where it is.
std::pair<double, double> worst_root(const std::vector<float>& x, const std::vector<double>& root) {
    std::pair<double, double> worst;
    for (size_t i = 0; i < x.size(); ++i) {
        const double off = std::abs(root[i] / std::cbrt(double(x[i])) - 1);
        if (!(off <= worst.first))
            worst = {off, double(x[i])};
    }
    return worst;
}

TEST_P(FastMath, CubeRootIsExactTo1e9) {
    // 1e-30 and 1e30 as floats lie on either side of the promised ends, by half an ulp at most.
    const auto x = geometric(1e-30, 1e30);
    std::vector<double> root(kCount);
    HWY_DYNAMIC_DISPATCH(CubeRoots)(x.data(), kCount, root.data());
    const auto worst = worst_root(x, root);
    EXPECT_LE(worst.first, 1e-9) << "at " << worst.second;
}

TEST_P(FastMath, CubeRootOfShareIsExactTo3e8) {
    const auto x = geometric(1.0 / 128, std::nextafter(2.0f, 0.0f));
    std::vector<double> root(kCount);
    HWY_DYNAMIC_DISPATCH(CubeRootsOfShares)(x.data(), kCount, root.data());
    const auto worst = worst_root(x, root);
    EXPECT_LE(worst.first, 3e-8) << "at " << worst.second;
}

// The high part of a sum must be so short that products with small integers are exact.
template <int kParts>
void expect_short_roots() {
    constexpr HWY_NAMESPACE::CubeRootTable<kParts> table;
    for (int i = 0; i < table.kEntries; ++i) {
        int exponent = 0;
        const double root = double(table.root[i]);
        const double mantissa = std::frexp(root, &exponent) * 256;
        EXPECT_EQ(mantissa, std::round(mantissa)) << i;
        const double cube = root * root * root;
        EXPECT_EQ(table.inverse[i], float(1 / cube)) << i;
        EXPECT_NEAR(double(table.inverse[i]) * cube, 1, 1.3e-8) << i;
        // Over its part of a binade x / cube - 1 stays where the series is exact.
        const double part = std::ldexp(1.0, i / kParts - 7) / kParts;
        const double range = kParts == 2 ? 0.236 : 0.348;
        EXPECT_GT((kParts + i % kParts) * part / cube - 1, -range) << i;
        EXPECT_LT((kParts + i % kParts + 1) * part / cube - 1, range) << i;
    }
}

TEST(CubeRootTable, HasShortRootsAndWhatDividesByTheirCubes) {
    expect_short_roots<1>();
    expect_short_roots<2>();
}

TEST_P(FastMath, Log2IsExactTo3e7) {
    const auto x = geometric(1.17549435e-38, 3.4028234e38);
    std::vector<double> log(kCount);
    HWY_DYNAMIC_DISPATCH(Logs)(x.data(), kCount, log.data());
    double worst = 0, at = 0;
    for (size_t i = 0; i < kCount; ++i) {
        const double exact = std::log2(double(x[i]));
        const double off = std::abs(log[i] - exact) / (1 + std::abs(exact));
        if (!(off <= worst)) {
            worst = off;
            at = double(x[i]);
        }
    }
    EXPECT_LT(worst, 3e-7) << "at " << at;
}

TEST_P(FastMath, Log2OfPowersOfTwoIsExact) {
    std::vector<float> x(256, 1.0f);
    for (int e = -126; e <= 127; ++e)
        x[size_t(e + 126)] = std::ldexp(1.0f, e);
    std::vector<double> log(x.size());
    HWY_DYNAMIC_DISPATCH(Logs)(x.data(), x.size(), log.data());
    for (int e = -126; e <= 127; ++e)
        EXPECT_EQ(log[size_t(e + 126)], e);
}

TEST_P(FastMath, Exp2IsExactTo3e7) {
    std::vector<float> x(kCount);
    for (size_t i = 0; i < kCount; ++i)
        x[i] = float(-126.0 + 253.0 * double(i) / double(kCount - 1));
    std::vector<double> power(kCount);
    HWY_DYNAMIC_DISPATCH(Powers)(x.data(), kCount, power.data());
    double worst = 0, at = 0;
    for (size_t i = 0; i < kCount; ++i) {
        const double off = std::abs(power[i] / std::exp2(double(x[i])) - 1);
        if (!(off <= worst)) {
            worst = off;
            at = double(x[i]);
        }
    }
    EXPECT_LT(worst, 3e-7) << "at " << at;
}

TEST_P(FastMath, Exp2OfWholeNumbersIsExact) {
    std::vector<float> x(256, 0.0f);
    for (int e = -126; e <= 127; ++e)
        x[size_t(e + 126)] = float(e);
    std::vector<double> power(x.size());
    HWY_DYNAMIC_DISPATCH(Powers)(x.data(), x.size(), power.data());
    for (int e = -126; e <= 127; ++e)
        EXPECT_EQ(power[size_t(e + 126)], std::ldexp(1.0, e));
}

// The largest relative error, and where it is.
template <class Exact>
std::pair<double, double> worst_share(const std::vector<float>& x, const std::vector<double>& y,
                                      const Exact& exact) {
    std::pair<double, double> worst;
    for (size_t i = 0; i < x.size(); ++i) {
        const double off = std::abs(y[i] / exact(double(x[i])) - 1);
        if (!(off <= worst.first))
            worst = {off, double(x[i])};
    }
    return worst;
}

constexpr double kLog2E = 1.4426950408889634;

TEST_P(FastMath, Log2OfOnePlusIsExactTo5e7) {
    const auto x = geometric(1e-30, 1e30);
    std::vector<double> log(kCount);
    HWY_DYNAMIC_DISPATCH(LogsOfOnePlus)(x.data(), kCount, log.data());
    const auto worst = worst_share(x, log, [](double v) { return kLog2E * std::log1p(v); });
    EXPECT_LT(worst.first, 5e-7) << "at " << worst.second;
}

TEST_P(FastMath, Exp2LessOneIsExactTo5e7) {
    std::vector<double> power(kCount);
    for (float sign : {-1.0f, 1.0f}) {
        auto x = geometric(1e-30, 126);
        for (float& v : x)
            v *= sign;
        HWY_DYNAMIC_DISPATCH(PowersLessOne)(x.data(), kCount, power.data());
        const auto worst = worst_share(x, power, [](double v) { return std::expm1(v / kLog2E); });
        EXPECT_LT(worst.first, 5e-7) << "at " << worst.second;
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, FastMath, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& test) { return hwy::TargetName(test.param); });

} // namespace
} // namespace tonetool::kernels
#endif
