// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "images.h"
#include "tonetool/flip.h"

namespace tonetool {
namespace {

using testing::Contains;
using testing::HasSubstr;
using ToneAlgo::error_map;
using ToneAlgo::error_metrics;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

ErrorOptions by(const std::string& metric) {
    ErrorOptions options;
    options.metric = metric;
    return options;
}

double mean_of(const ImageBuf& map) {
    double sum = 0;
    for (const float v : values(map))
        sum += double(v);
    return sum / double(map.spec().image_pixels());
}

class EveryMetric : public testing::TestWithParam<std::string> {
protected:
    const ImageBuf m_reference = noise(50, 40, 1), m_test = disturbed(m_reference, 0.3, 2);
    const ErrorOptions m_options = by(GetParam());
    bool bounded() const { return GetParam() == "smape" || GetParam() == "mpsnr"; }
};

INSTANTIATE_TEST_SUITE_P(All, EveryMetric, testing::ValuesIn(error_metrics()),
                         [](const auto& test) { return test.param; });

TEST_P(EveryMetric, IdenticalImagesHaveNoError) {
    ErrorSummary s;
    const auto map = error_map(m_reference, m_reference, m_options, &s);
    ASSERT_FALSE(map.has_error()) << map.geterror();
    EXPECT_EQ(s.pool.max, 0);
    EXPECT_EQ(s.value, s.decibels ? INFINITY : 0);
    EXPECT_TRUE(s.warnings.empty());
}

TEST_P(EveryMetric, ValueIsMadeOfTheMap) {
    ErrorSummary s;
    const auto map = error_map(m_reference, m_test, m_options, &s);
    ASSERT_FALSE(map.has_error()) << map.geterror();
    const double mean = mean_of(map);
    EXPECT_GT(mean, 0);
    EXPECT_NEAR(s.pool.mean, mean, 1e-12 * mean); // sums of doubles in another order
    EXPECT_NEAR(s.value, s.decibels ? -10 * std::log10(mean) : mean, 1e-9);
    EXPECT_EQ(s.metric, GetParam());
    EXPECT_EQ(s.exposures.empty(), GetParam() != "mpsnr");
    EXPECT_EQ(map.spec().get_string_attribute("Error:metric"), GetParam());
    EXPECT_EQ(map.spec().get_float_attribute("Error:meanerror"), float(mean));
    EXPECT_FALSE(map.spec().find_attribute("FLIP:meanerror"));
}

TEST_P(EveryMetric, ThreadsBandsAndRegionsDoNotChangeABit) {
    const auto reference = noise(150, 700, 1), test = disturbed(reference, 0.3, 2);
    ErrorSummary one, many;
    const auto map = error_map(reference, test, m_options, &one, {}, 1);
    for (int n : {2, 3, 0}) {
        EXPECT_EQ(values(map), values(error_map(reference, test, m_options, &many, {}, n)));
        EXPECT_EQ(one.value, many.value);
    }
    ErrorOptions narrow = m_options;
    narrow.memory = 1;
    const std::string refusal = error_map(reference, test, narrow).geterror();
    ASSERT_THAT(refusal, HasSubstr("needs at least ")) << "in narrow bands";
    narrow.memory = std::stoull(refusal.substr(refusal.find("at least ") + 9)) << 20;
    EXPECT_EQ(values(map), values(error_map(reference, test, narrow)));
    const ROI roi(20, 90, 30, 600);
    const auto part = error_map(reference, test, m_options, nullptr, roi);
    EXPECT_EQ(part.roi().width(), 70);
    EXPECT_EQ(pixel_of(part, 41, 333), pixel_of(map, 41, 333));
}

TEST_P(EveryMetric, ANonFinitePixelIsTheLargestError) {
    for (const float bad : {kNan, kInf, -kInf}) {
        const auto hole = with_pixel(m_test, 20, 15, {1, bad, 1});
        ErrorSummary plain, s;
        error_map(m_reference, m_test, m_options, &plain);
        for (const bool in_test : {true, false}) {
            const auto map = in_test ? error_map(m_reference, hole, m_options, &s)
                                     : error_map(hole, m_reference, m_options, &s);
            const float found = pixel_of(map, 20, 15)[0];
            const bool lost = in_test && !bounded(); // nothing bounds its error
            EXPECT_EQ(lost ? std::numeric_limits<double>::infinity() : double(found), s.pool.max);
            EXPECT_EQ(std::isinf(s.pool.mean), lost);
            EXPECT_EQ(std::isinf(s.value), lost);
            EXPECT_GE(found, 1.0f);
            if (bounded())
                EXPECT_EQ(found, 1.0f);
            EXPECT_EQ((in_test ? s.test : s.reference).nonfinite, 1);
            EXPECT_THAT(s.warnings, Contains(HasSubstr("NaN or Inf")));
        }
        const auto both = error_map(hole, hole, m_options, &s);
        EXPECT_EQ(s.pool.max, 0);
        EXPECT_EQ(s.nonfinite_both, 1);
        EXPECT_THAT(s.warnings, Contains(HasSubstr("in both")));
    }
}

TEST_P(EveryMetric, NothingFiniteIsAnError) {
    const auto nothing = constant(50, 40, {kNan, 1, 1});
    EXPECT_THAT(error_map(m_reference, nothing, m_options).geterror(),
                HasSubstr("the test has no finite pixel"));
    EXPECT_THAT(error_map(nothing, m_reference, m_options).geterror(),
                HasSubstr("the reference has no finite pixel"));
}

TEST_P(EveryMetric, NegativeIs0AndCounted) {
    const auto negative = with_pixel(m_test, 3, 4, {-1, 0.5f, -2});
    const auto clamped = with_pixel(m_test, 3, 4, {0, 0.5f, 0});
    ErrorSummary s;
    EXPECT_EQ(values(error_map(m_reference, negative, m_options, &s)),
              values(error_map(m_reference, clamped, m_options)));
    EXPECT_EQ(s.test.negative, 1);
    error_map(with_pixel(m_reference, 3, 4, {0, 1, 1}), with_pixel(m_reference, 3, 4, {-1, 1, 1}),
              m_options, &s);
    EXPECT_EQ(s.pool.max, 0);
    EXPECT_THAT(s.warnings, Contains(HasSubstr("differ in negative values")));
}

TEST(ErrorMap, LargestErrorOfAHoleIsThatOfTheOtherPixels) {
    const auto reference = constant(8, 8, {1, 1, 1});
    const auto test = with_pixel(with_pixel(reference, 1, 1, {4, 4, 4}), 5, 5, {kNan, 1, 1});
    const auto map = error_map(reference, test, by("mse"));
    EXPECT_EQ(pixel_of(map, 1, 1)[0], 9.0f);
    EXPECT_EQ(pixel_of(map, 5, 5)[0], 9.0f);
    EXPECT_EQ(pixel_of(map, 0, 0)[0], 0.0f);
}

TEST(ErrorMap, OptionsReachTheFormulas) {
    const auto reference = constant(8, 8, {1, 1, 1}), test = constant(8, 8, {1.5f, 1.5f, 1.5f});
    ErrorSummary s;
    ErrorOptions options = by("relmse");
    error_map(reference, test, options, &s);
    EXPECT_NEAR(s.value, 0.25 / 1.01, 1e-7);
    EXPECT_EQ(s.eps, 0.01);
    options.eps = 1;
    error_map(reference, test, options, &s);
    EXPECT_NEAR(s.value, 0.125, 1e-9);
    options = by("psnr");
    options.peak = 10;
    error_map(reference, test, options, &s);
    EXPECT_NEAR(s.value, 10 * std::log10(100 / 0.25), 1e-9);
    EXPECT_EQ(s.peak, 10);
    EXPECT_EQ(s.eps, 0);
}

TEST(ErrorMap, MpsnrTakesTheExposuresOfHdrFlip) {
    const auto reference = noise(50, 40, 1), test = disturbed(reference, 0.3, 2);
    ErrorSummary s;
    FlipResult flip;
    error_map(reference, test, by("mpsnr"), &s);
    ToneAlgo::hdr_flip(reference, test, {}, &flip);
    EXPECT_EQ(s.exposures, flip.summary.exposures);
    EXPECT_EQ(s.max_luminance, flip.summary.max_luminance);
    ErrorOptions options = by("mpsnr");
    options.start_exposure = -2;
    options.stop_exposure = 1;
    options.num_exposures = 4;
    error_map(reference, test, options, &s);
    EXPECT_EQ(s.exposures, (std::vector<double>{-2, -1, 0, 1}));
}

TEST(ErrorMap, AlphaJoinsAsADifference) {
    const auto spec = make_spec(12, 8, {"R", "G", "B", "A"});
    const auto opaque = constant(spec, {0.2f, 0.3f, 0.4f, 1});
    const auto half = constant(spec, {0.2f, 0.3f, 0.4f, 0.5f});
    ErrorOptions options = by("mae");
    ErrorSummary s;
    error_map(opaque, half, options, &s);
    EXPECT_EQ(s.value, 0);
    options.alpha = AlphaPolicy::Error;
    error_map(opaque, half, options, &s);
    EXPECT_EQ(s.value, 0.5);
    EXPECT_EQ(s.alpha_mean, 0.5);
}

TEST(ErrorMap, DifferencesTooSmallForTheMapAreWarnings) {
    const auto reference = constant(8, 8, {1e-30f, 1e-30f, 1e-30f});
    ErrorSummary s;
    error_map(reference, constant(8, 8, {2e-30f, 1e-30f, 1e-30f}), by("mse"), &s);
    EXPECT_EQ(s.pool.max, 0);
    EXPECT_THAT(s.warnings, Contains(HasSubstr("64 pixel(s) differ")));
}

TEST(ErrorMap, GeometryIsThatOfFlip) {
    const auto reference = noise(20, 10, 1), test = noise(10, 5, 2);
    EXPECT_THAT(error_map(reference, test, by("mae")).geterror(), HasSubstr("display window"));
    ErrorOptions options = by("mae");
    options.size = SizePolicy::Resize;
    EXPECT_EQ(error_map(reference, test, options).roi().width(), 20);
    options.size = SizePolicy::Crop;
    EXPECT_EQ(error_map(reference, test, options).roi().width(), 10);
}

TEST(ErrorMap, BadOptionsAreErrors) {
    const auto image = noise(8, 8, 1);
    EXPECT_THAT(error_map(image, image, by("mspe")).geterror(),
                AllOf(HasSubstr("error_map: unknown metric \"mspe\"; "),
                      HasSubstr("valid: smape, rmae, relmse")));
    EXPECT_THAT(error_map(image, image, by("")).geterror(), HasSubstr("unknown metric"));
    ErrorOptions options = by("smape");
    for (const double eps : {0.0, -1.0, 1e13, double(kNan)}) {
        options.eps = eps;
        EXPECT_THAT(error_map(image, image, options).geterror(), HasSubstr("eps is"));
    }
    options = by("psnr");
    options.peak = 0;
    EXPECT_THAT(error_map(image, image, options).geterror(), HasSubstr("peak is 0"));
    options = by("mpsnr");
    options.num_exposures = 0;
    EXPECT_THAT(error_map(image, image, options).geterror(), HasSubstr("numExposures is 0"));
}

} // namespace
} // namespace tonetool
