// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/errors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace tonetool::metrics {
namespace {

using Rgb = std::array<float, 3>;

float error_of(const PixelError& error, const Rgb& r, const Rgb& t,
               const std::vector<double>& stops = {0}) {
    const float *reference[3] = {&r[0], &r[1], &r[2]}, *test[3] = {&t[0], &t[1], &t[2]};
    float out = -1;
    error_row(error, stops, reference, test, &out, 1);
    return out;
}

constexpr ErrorKind kKinds[] = {ErrorKind::Absolute,         ErrorKind::Squared,
                                ErrorKind::RelativeAbsolute, ErrorKind::RelativeSquared,
                                ErrorKind::Symmetric,        ErrorKind::Exposed};

TEST(PixelErrors, AreTheFormulas) {
    const Rgb r{1, 0, 4}, t{3, 0.5f, 4};
    EXPECT_FLOAT_EQ(error_of({ErrorKind::Absolute, 0}, r, t), 2.5f / 3);
    EXPECT_FLOAT_EQ(error_of({ErrorKind::Squared, 0}, r, t), 4.25f / 3);
    EXPECT_FLOAT_EQ(error_of({ErrorKind::RelativeAbsolute, 0.25}, r, t),
                    (2 / 1.25f + 0.5f / 0.25f) / 3);
    EXPECT_FLOAT_EQ(error_of({ErrorKind::RelativeSquared, 0.25}, r, t),
                    (4 / 1.25f + 0.25f / 0.25f) / 3);
    EXPECT_FLOAT_EQ(error_of({ErrorKind::Symmetric, 0.25}, r, t), (2 / 4.25f + 0.5f / 0.75f) / 3);
}

TEST(PixelErrors, ExposedIsOfEightBitPhotographs) {
    const PixelError error{ErrorKind::Exposed, 0};
    // 255 0.5^(1/2.2) = 186.08; a stop down 135.79 and 99.09 of 0.25; white stays white above.
    const Rgb white{1, 1, 1}, half{0.5f, 0.5f, 0.5f};
    EXPECT_FLOAT_EQ(error_of(error, white, half), 69.0f * 69 / (255 * 255));
    EXPECT_FLOAT_EQ(error_of(error, white, half, {-1}), (186.0f - 136) * (186 - 136) / (255 * 255));
    EXPECT_EQ(error_of(error, white, half, {1}), 0.0f);
    EXPECT_FLOAT_EQ(error_of(error, white, half, {-1, 0, 1}),
                    (50.0f * 50 + 69 * 69) / (3 * 255 * 255));
    EXPECT_EQ(error_of(error, white, {1, 1, 0.9999f}), 0.0f) << "rounds to the same code";
    EXPECT_FLOAT_EQ(error_of(error, {0, 0, 0}, {1e30f, 1e30f, 1e30f}), 1.0f);
}

TEST(PixelErrors, EqualPixelsHaveNone) {
    const float most = std::numeric_limits<float>::max();
    for (const ErrorKind kind : kKinds)
        for (const float v : {0.0f, 1e-40f, 0.18f, 1e30f, most})
            EXPECT_EQ(error_of({kind, 0.01}, {v, 1, v}, {v, 1, v}), 0.0f) << int(kind) << " " << v;
}

TEST(PixelErrors, GrowWithTheDifferenceAndStayFinite) {
    const float most = std::numeric_limits<float>::max();
    for (const ErrorKind kind : kKinds) {
        const PixelError error{kind, 0.01};
        float last = 0;
        for (const float v : {0.2f, 0.3f, 0.5f, 2.0f, 1e5f, 1e20f, most}) {
            const float e = error_of(error, {0.18f, 0.18f, 0.18f}, {v, v, v});
            EXPECT_GE(e, last) << int(kind) << " " << v;
            EXPECT_LE(e, error.bounded() ? 1.0f : most);
            last = e;
        }
        EXPECT_GT(last, 0.1f);
    }
}

TEST(ErrorMetrics, EachIsARowOfOneKernel) {
    std::set<std::string> names;
    std::set<ErrorKind> kinds;
    for (const ErrorMetric& metric : kErrorMetrics) {
        EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
        kinds.insert(metric.kind);
        EXPECT_EQ(find_error_metric(metric.name), &metric);
        EXPECT_EQ((PixelError{metric.kind, 0.01}.bounded()), metric.has(kBounded)) << metric.name;
        EXPECT_TRUE(metric.has(kDecibels) || !metric.has(kPeak)) << metric.name;
    }
    for (const ErrorKind kind : kKinds)
        EXPECT_EQ(kinds.count(kind), 1U) << int(kind);
    EXPECT_EQ(find_error_metric("mspe"), nullptr);
}

TEST(ErrorMetrics, TheMeasureIsTheMeanOrThatInDecibels) {
    for (const ErrorMetric& metric : kErrorMetrics) {
        const bool decibels = metric.has(kDecibels);
        EXPECT_DOUBLE_EQ(metric.measure(0.01, 1), decibels ? 20 : 0.01) << metric.name;
        EXPECT_EQ(metric.measure(0, 1), decibels ? INFINITY : 0) << metric.name;
        EXPECT_EQ(metric.measure(0.02, 1) > metric.measure(0.01, 1), !decibels) << metric.name;
    }
    EXPECT_DOUBLE_EQ(find_error_metric("psnr")->measure(0.25, 10), 10 * std::log10(400));
}

TEST(PixelErrors, SymmetricIsSymmetric) {
    const Rgb a{0.1f, 2, 0}, b{0.4f, 1, 7};
    for (const ErrorKind kind : {ErrorKind::Absolute, ErrorKind::Squared, ErrorKind::Symmetric})
        EXPECT_EQ(error_of({kind, 0.01}, a, b), error_of({kind, 0.01}, b, a));
}

} // namespace
} // namespace tonetool::metrics
