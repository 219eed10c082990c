#include "sequence/results/shot_exposures.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <stdexcept>

namespace tonetool::sequence {
namespace {

const ExposureSamples samples{{3, "", 2, 0.25}, {1, "", 8, 1.0 / 3}, {2, "", 4, 0.5}};

TEST(ShotExposures, Maximum_of_maxima_and_median_of_medians) {
    const ShotExposures range = shot_exposures(samples);
    EXPECT_EQ(range.max_luminance, 8);
    EXPECT_EQ(range.median_luminance, 1.0 / 3);
    EXPECT_EQ(range.frames, 3);
}

TEST(ShotExposures, Of_an_even_number_the_upper_median) {
    EXPECT_EQ(shot_exposures({samples[0], samples[2]}).median_luminance, 0.5);
}

TEST(ShotExposures, Order_has_no_say_and_black_frames_have_none) {
    ExposureSamples other = samples;
    std::sort(other.begin(), other.end(),
              [](const auto& a, const auto& b) { return a.frame < b.frame; });
    other.push_back({4, "", 0, 0});
    EXPECT_EQ(shot_exposures(other), shot_exposures(samples));
    EXPECT_THROW(shot_exposures({{4, "", 0, 0}}), std::runtime_error);
}

TEST(ShotExposures, Keep_the_names_of_what_they_were_measured_on) {
    ExposureSamples named = samples;
    for (ExposureSample& sample : named) {
        sample.reference = "nowhere/r." + std::to_string(sample.frame) + ".exr";
    }
    const ShotExposures range = shot_exposures(samples_from_json(to_json(named)));
    EXPECT_THAT(range.references,
                testing::ElementsAre("nowhere/r.1.exr", "nowhere/r.2.exr", "nowhere/r.3.exr"));
    EXPECT_TRUE(was_measured_on(range, "nowhere/./r.2.exr"));
    EXPECT_FALSE(was_measured_on(range, "elsewhere/r.2.exr"));
    EXPECT_FALSE(was_measured_on(range, "r.2.exr"));
    EXPECT_FALSE(was_measured_on(range, "nowhere/r.4.exr"));
    EXPECT_TRUE(was_measured_on(shot_exposures(samples), "r.4.exr")); // nothing is known
    EXPECT_FALSE(range == shot_exposures(samples));
}

TEST(ShotExposures, Files_come_back_to_the_bit_sorted) {
    const ExposureSamples back = samples_from_json(to_json(samples));
    ASSERT_EQ(back.size(), 3u);
    EXPECT_EQ(back[0].frame, 1);
    EXPECT_EQ(back[0].median_luminance, 1.0 / 3);
    EXPECT_EQ(to_json(back), to_json(samples));
    EXPECT_THROW(samples_from_json("{}"), std::runtime_error);
    EXPECT_THROW(to_json({samples[0], samples[0]}), std::runtime_error);
}

TEST(ShotExposures, Numbers_that_do_not_fit_are_named) {
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
    for (const char* frame : {"1e99", "1099511627776", "-2147483649", "1.5", "\"nan\"", "null"}) {
        EXPECT_THAT(refusal(frame, "2"), testing::HasSubstr("samples/0: \"frame\" is ")) << frame;
    }
    for (const char* maximum : {"\"nan\"", "null", "[1]", "true"}) {
        EXPECT_THAT(refusal("1", maximum), testing::HasSubstr("\"max_luminance\" is ")) << maximum;
    }
    EXPECT_THAT(refusal("1", "1e999"), testing::HasSubstr("1e999"));
    EXPECT_THAT(refusal("1", "NaN"), testing::HasSubstr("parse error"));
}

} // namespace
} // namespace tonetool::sequence
