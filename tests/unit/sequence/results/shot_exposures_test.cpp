// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/shot_exposures.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <stdexcept>

namespace tonetool::sequence {
namespace {

const ExposureSamples kSamples{{3, "", 2, 0.25}, {1, "", 8, 1.0 / 3}, {2, "", 4, 0.5}};

TEST(ShotExposures, MaximumOfMaximaAndMedianOfMedians) {
    const ShotExposures range = shot_exposures(kSamples);
    EXPECT_EQ(range.max_luminance, 8);
    EXPECT_EQ(range.median_luminance, 1.0 / 3);
    EXPECT_EQ(range.frames, 3);
}

TEST(ShotExposures, OfAnEvenNumberTheUpperMedian) {
    EXPECT_EQ(shot_exposures({kSamples[0], kSamples[2]}).median_luminance, 0.5);
}

TEST(ShotExposures, OrderHasNoSayAndBlackFramesHaveNone) {
    ExposureSamples other = kSamples;
    std::sort(other.begin(), other.end(),
              [](const auto& a, const auto& b) { return a.frame < b.frame; });
    other.push_back({4, "", 0, 0});
    EXPECT_EQ(shot_exposures(other), shot_exposures(kSamples));
    EXPECT_THROW(shot_exposures({{4, "", 0, 0}}), std::runtime_error);
}

TEST(ShotExposures, KeepTheNamesOfWhatTheyWereMeasuredOn) {
    ExposureSamples named = kSamples;
    for (ExposureSample& sample : named)
        sample.reference = "nowhere/r." + std::to_string(sample.frame) + ".exr";
    const ShotExposures range = shot_exposures(samples_from_json(to_json(named)));
    EXPECT_THAT(range.references,
                testing::ElementsAre("nowhere/r.1.exr", "nowhere/r.2.exr", "nowhere/r.3.exr"));
    EXPECT_TRUE(was_measured_on(range, "nowhere/./r.2.exr"));
    EXPECT_FALSE(was_measured_on(range, "elsewhere/r.2.exr"));
    EXPECT_FALSE(was_measured_on(range, "r.2.exr"));
    EXPECT_FALSE(was_measured_on(range, "nowhere/r.4.exr"));
    EXPECT_TRUE(was_measured_on(shot_exposures(kSamples), "r.4.exr")); // nothing is known
    EXPECT_FALSE(range == shot_exposures(kSamples));
}

TEST(ShotExposures, FilesComeBackToTheBitSorted) {
    const ExposureSamples back = samples_from_json(to_json(kSamples));
    ASSERT_EQ(back.size(), 3u);
    EXPECT_EQ(back[0].frame, 1);
    EXPECT_EQ(back[0].median_luminance, 1.0 / 3);
    EXPECT_EQ(to_json(back), to_json(kSamples));
    EXPECT_THROW(samples_from_json("{}"), std::runtime_error);
    EXPECT_THROW(to_json({kSamples[0], kSamples[0]}), std::runtime_error);
}

TEST(ShotExposures, NumbersThatDoNotFitAreNamed) {
    const auto refusal = [](const std::string& frame, const std::string& maximum) {
        try {
            samples_from_json(R"({"format":"tonetool-exposures","version":1,"samples":[{"frame":)" +
                              frame + R"(,"max_luminance":)" + maximum +
                              R"(,"median_luminance":1}]})");
        } catch (const std::runtime_error& problem) {
            return std::string(problem.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(refusal("1", "2"), "accepted");
    for (const char* frame : {"1e99", "1099511627776", "-2147483649", "1.5", "\"nan\"", "null"})
        EXPECT_THAT(refusal(frame, "2"), testing::HasSubstr("samples/0: \"frame\" is ")) << frame;
    for (const char* maximum : {"\"nan\"", "null", "[1]", "true"})
        EXPECT_THAT(refusal("1", maximum), testing::HasSubstr("\"max_luminance\" is ")) << maximum;
    EXPECT_THAT(refusal("1", "1e999"), testing::HasSubstr("1e999"));
    EXPECT_THAT(refusal("1", "NaN"), testing::HasSubstr("parse error"));
}

} // namespace
} // namespace tonetool::sequence
