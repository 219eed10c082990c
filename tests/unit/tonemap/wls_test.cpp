// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/wls.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "hdr_image.h"

namespace tonetool::tonemap {
namespace {

using kernels::Content;
using Plane = std::vector<float>;

// All of it factorised, and as little as can be.
const WlsMethod kDirect{std::numeric_limits<int>::max()}, kIterative{10};

const float kNan = std::numeric_limits<float>::quiet_NaN();

Plane luminance(Content content, int width, int height, uint32_t seed) {
    return kernels::make_image(content, width, height, seed).plane[1];
}

Plane base_of(const WlsTerms& terms, const Plane& image, int width,
              const WlsMethod& method = kDirect) {
    Plane out(image.size());
    wls_base(terms, image.data(), width, int(image.size()) / width, out.data(), method);
    return out;
}

std::vector<WlsTerms> all_terms() {
    std::vector<WlsTerms> all;
    for (bool logarithmic : {true, false})
        for (double alpha : {0.0, 1.2, 4.0})
            for (double lambda : {1e-5, 0.125, 1.0, 100.0})
                all.push_back({alpha, lambda, logarithmic});
    return all;
}

// The sum of squares as it is written, its normal equations by full pivoting.
Plane dense(const WlsTerms& terms, const Plane& image, int width) {
    const auto n = Eigen::Index(image.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd data(n);
    const auto log_of = [&](Eigen::Index i) { return std::log(double(image[size_t(i)])); };
    const auto lit = [&](Eigen::Index i) {
        return std::isfinite(image[size_t(i)]) && image[size_t(i)] > 0;
    };
    const auto couple = [&](Eigen::Index i, Eigen::Index j) {
        if (!lit(i) || !lit(j))
            return;
        const double w = 1 / (std::pow(std::abs(log_of(i) - log_of(j)), terms.alpha) + 1e-4);
        Eigen::VectorXd difference = Eigen::VectorXd::Zero(n);
        difference[i] = 1;
        difference[j] = -1;
        normal += terms.lambda * w * difference * difference.transpose();
    };
    for (Eigen::Index i = 0; i < n; ++i) {
        data[i] = !lit(i) ? 0 : terms.logarithmic ? log_of(i) : double(image[size_t(i)]);
        if ((i + 1) % width != 0)
            couple(i, i + 1);
        if (i + width < n)
            couple(i, i + width);
    }
    const Eigen::VectorXd u = normal.fullPivLu().solve(data);
    Plane out(image.size());
    for (Eigen::Index i = 0; i < n; ++i)
        out[size_t(i)] = lit(i) ? float(u[i]) : kNan;
    return out;
}

// Largest difference: of logarithms or, where they are none, of the expected value.
double distance(const WlsTerms& terms, const Plane& ours, const Plane& expected) {
    double most = 0;
    for (size_t i = 0; i < ours.size(); ++i) {
        EXPECT_EQ(std::isnan(ours[i]), std::isnan(expected[i])) << i;
        if (!std::isnan(expected[i]))
            most = std::max(most, std::abs(double(ours[i]) - double(expected[i])) /
                                      (terms.logarithmic ? 1 : std::abs(double(expected[i]))));
    }
    return most;
}

double roughness(const Plane& p) {
    double sum = 0;
    for (size_t i = 1; i < p.size(); ++i)
        sum += std::abs(double(p[i]) - double(p[i - 1]));
    return sum;
}

TEST(Wls, IsTheDenseSolution) {
    for (Content content : {Content::Noise, Content::Gradient, Content::Patches}) {
        Plane image = luminance(content, 11, 9, 1);
        image[13] = 0;
        image[40] = kNan;
        image[41] = std::numeric_limits<float>::infinity();
        image[77] = -1;
        for (const WlsTerms& terms : all_terms())
            for (const WlsMethod& method : {kDirect, kIterative, WlsMethod()})
                EXPECT_LE(
                    distance(terms, base_of(terms, image, 11, method), dense(terms, image, 11)),
                    1e-6)
                    << content << " " << terms.alpha << " " << terms.lambda;
    }
}

TEST(Wls, SolversAgree) {
    for (Content content : {Content::Noise, Content::Gradient, Content::Patches})
        for (const WlsTerms& terms : all_terms()) {
            const Plane image = luminance(content, 64, 50, 2);
            EXPECT_LE(
                distance(terms, base_of(terms, image, 64, kIterative), base_of(terms, image, 64)),
                1e-6)
                << content << " " << terms.alpha << " " << terms.lambda;
        }
}

TEST(Wls, AConstantStays) {
    for (float light : {1e-30f, 0.02f, 7.0f, 1e30f})
        for (const WlsTerms& terms : all_terms()) {
            const float expected = terms.logarithmic ? float(std::log(double(light))) : light;
            for (float u : base_of(terms, Plane(60, light), 10))
                ASSERT_NEAR(double(u / expected), 1, 1e-6);
        }
}

TEST(Wls, WithoutSmoothnessItIsTheData) {
    const Plane image = luminance(Content::Noise, 20, 15, 3);
    EXPECT_EQ(base_of({1.2, 0, false}, image, 20), image);
    const Plane logarithms = base_of({1.2, 0, true}, image, 20);
    for (size_t i = 0; i < image.size(); ++i)
        EXPECT_EQ(logarithms[i], float(std::log(double(image[i]))));
}

TEST(Wls, MoreLambdaIsFlatterAndNothingLeavesTheRange) {
    for (Content content : {Content::Noise, Content::Gradient})
        for (bool logarithmic : {true, false}) {
            const Plane image = luminance(content, 40, 30, 4);
            const Plane data = base_of({1.2, 0, logarithmic}, image, 40);
            const auto [least, most] = std::minmax_element(data.begin(), data.end());
            double last = roughness(data);
            for (double lambda : {0.01, 0.125, 1.0, 10.0, 100.0}) {
                const Plane u = base_of({1.2, lambda, logarithmic}, image, 40);
                EXPECT_LT(roughness(u), last) << lambda;
                last = roughness(u);
                EXPECT_GE(*std::min_element(u.begin(), u.end()), *least);
                EXPECT_LE(*std::max_element(u.begin(), u.end()), *most);
            }
        }
}

// A wall of noise under two lights: the noise goes, the step stays, the more so with a larger
// alpha.
TEST(Wls, KeepsEdges) {
    Plane image(40 * 30);
    kernels::Uniform random(5);
    for (size_t i = 0; i < image.size(); ++i)
        image[i] = float((i % 40 < 20 ? 0.05 : 50.0) * (1 + 0.02 * (random() - 0.5)));
    const Plane data = base_of({1, 0, true}, image, 40);
    const double step = std::log(1000.0);
    double last = 0;
    Plane u;
    for (double alpha : {0.4, 1.2, 2.0}) {
        u = base_of({alpha, 1, true}, image, 40);
        const double kept = double(u[15 * 40 + 20] - u[15 * 40 + 19]) / step;
        EXPECT_GT(kept, last);
        last = kept;
    }
    EXPECT_GT(last, 0.98);
    const auto wall = u.cbegin() + 15 * 40, noise = data.cbegin() + 15 * 40;
    EXPECT_LT(roughness({wall, wall + 20}), 0.1 * roughness({noise, noise + 20}));
}

TEST(Wls, FollowsExposure) {
    const Plane image = luminance(Content::Noise, 30, 20, 6);
    Plane brighter = image;
    for (float& v : brighter)
        v *= 1024;
    const Plane linear = base_of({}, image, 30), log = base_of({1.2, 0.125, true}, image, 30);
    const Plane linear2 = base_of({}, brighter, 30),
                log2 = base_of({1.2, 0.125, true}, brighter, 30);
    for (size_t i = 0; i < image.size(); ++i) {
        EXPECT_NEAR(double(linear2[i] / linear[i]), 1024, 1e-3);
        EXPECT_NEAR(double(log2[i] - log[i]), std::log(1024.0), 2e-6);
    }
}

TEST(Wls, PixelsWithoutLightDivide) {
    const Plane image = luminance(Content::Gradient, 21, 12, 7);
    for (float hole : {0.0f, -2.0f, kNan, std::numeric_limits<float>::infinity(), 1e-40f}) {
        Plane divided = image, left, right;
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 21; ++x) {
                const size_t i = size_t(y * 21 + x);
                if (x == 10)
                    divided[i] = hole;
                else
                    (x < 10 ? left : right).push_back(image[i]);
            }
        const WlsTerms terms{1.2, 10, true};
        const Plane u = base_of(terms, divided, 21), l = base_of(terms, left, 10),
                    r = base_of(terms, right, 10);
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 10; ++x) {
                EXPECT_NEAR(double(u[size_t(y * 21 + x)]), double(l[size_t(y * 10 + x)]), 1e-6);
                EXPECT_NEAR(double(u[size_t(y * 21 + 11 + x)]), double(r[size_t(y * 10 + x)]),
                            1e-6);
                EXPECT_TRUE(std::isnan(u[size_t(y * 21 + 10)]));
            }
    }
}

TEST(Wls, SmallAndExtremeImages) {
    for (const WlsTerms& terms : all_terms())
        for (const WlsMethod& method : {kDirect, kIterative}) {
            EXPECT_NEAR(double(base_of(terms, {1}, 1, method)[0]), terms.logarithmic ? 0 : 1, 0);
            EXPECT_TRUE(std::isnan(base_of(terms, {0}, 1, method)[0]));
            const Plane line = luminance(Content::Noise, 17, 1, 8);
            const Plane across = base_of(terms, line, 17, method);
            EXPECT_LE(distance(terms, across, dense(terms, line, 17)), 1e-6);
            EXPECT_LE(distance(terms, base_of(terms, line, 1, method), across), 1e-6);
            const Plane extreme{1e-37f, 3e38f, 1, 1, 1e-20f, 1e30f};
            EXPECT_LE(distance(terms, base_of(terms, extreme, 3, method), dense(terms, extreme, 3)),
                      1e-6);
        }
}

TEST(Wls, MayWorkInPlace) {
    Plane image = luminance(Content::Noise, 20, 15, 9);
    const Plane expected = base_of({}, image, 20);
    wls_base({}, image.data(), 20, 15, image.data());
    EXPECT_EQ(image, expected);
}

TEST(Wls, UnconvergedIsAnError) {
    const Plane image = luminance(Content::Gradient, 96, 70, 10);
    Plane out(image.size(), -1);
    EXPECT_THROW(wls_base({1.2, 100, true}, image.data(), 96, 70, out.data(), {10, 1}),
                 std::runtime_error);
    EXPECT_EQ(out, Plane(image.size(), -1)) << "nothing is written";
}

} // namespace
} // namespace tonetool::tonemap
