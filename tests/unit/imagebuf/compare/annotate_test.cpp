// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <OpenImageIO/strutil.h>

#include "images.h"
#include "tonetool/flip.h"

namespace tonetool {
namespace {

using testing::HasSubstr;

float number(const ImageBuf& map, const std::string& name) {
    const auto* attribute = map.spec().find_attribute("FLIP:" + name);
    if (!attribute)
        return -1;
    return attribute->type() == OIIO::TypeInt ? float(attribute->get_int())
                                              : attribute->get_float();
}

TEST(Annotate, HdrMapsCarryTheirSummary) {
    const auto reference = noise(20, 15, 1);
    FlipResult result;
    const auto map = ToneAlgo::hdr_flip(
        reference, with_pixel(disturbed(reference, 0.2, 2), 1, 1, {-1, 0, NAN}), {}, &result);
    const FlipSummary& s = result.summary;
    const std::pair<const char*, double> numbers[] = {{"meanerror", s.pool.mean},
                                                      {"maxerror", s.pool.max},
                                                      {"maxx", s.pool.max_x},
                                                      {"maxy", s.pool.max_y},
                                                      {"minerror", s.pool.min},
                                                      {"weightedquartile1", s.pool.weighted_q1},
                                                      {"weightedmedian", s.pool.weighted_median},
                                                      {"weightedquartile3", s.pool.weighted_q3},
                                                      {"p50", s.pool.p50},
                                                      {"p95", s.pool.p95},
                                                      {"p99", s.pool.p99},
                                                      {"p99.9", s.pool.p999},
                                                      {"pixels", 300},
                                                      {"referenceNonfinite", 0},
                                                      {"testNonfinite", 1},
                                                      {"testNegative", 0},
                                                      {"testUncovered", 0},
                                                      {"bothNonfinite", 0},
                                                      {"unlikeNonfinite", 0},
                                                      {"alphaIgnored", 0},
                                                      {"ppd", s.ppd},
                                                      {"startExposure", s.exposures.front()},
                                                      {"stopExposure", s.exposures.back()},
                                                      {"numExposures", double(s.exposures.size())},
                                                      {"maxLuminance", s.max_luminance},
                                                      {"medianLuminance", s.median_luminance},
                                                      {"medianOfLit", 0}};
    for (const auto& [name, value] : numbers)
        EXPECT_EQ(number(map, name), float(value)) << name;
    EXPECT_EQ(map.spec().get_string_attribute("FLIP:tonemapper"), "aces");
    EXPECT_EQ(map.spec().get_string_attribute("FLIP:referenceLayer"), "R,G,B");
    EXPECT_EQ(map.spec().get_string_attribute("FLIP:testSpace"), "rec709");
    EXPECT_THAT(map.spec().get_string_attribute("FLIP:warnings"), HasSubstr("NaN or Inf"));
    EXPECT_THAT(map.spec().get_string_attribute("FLIP:version"), HasSubstr(tonetool::version()));
    std::vector<int> histogram;
    OIIO::Strutil::extract_from_list_string(histogram,
                                            map.spec().get_string_attribute("FLIP:histogram"), " ");
    ASSERT_EQ(histogram.size(), 100u);
    for (size_t i = 0; i < 100; ++i)
        EXPECT_EQ(histogram[i], s.pool.histogram[i]);
}

TEST(Annotate, LdrMapsHaveNoExposures) {
    const auto reference = noise(20, 15, 1);
    const auto map = ToneAlgo::ldr_flip(reference, disturbed(reference, 0.2, 2));
    EXPECT_GT(number(map, "meanerror"), 0);
    EXPECT_GT(number(map, "ppd"), 67);
    for (const char* name :
         {"FLIP:startExposure", "FLIP:tonemapper", "FLIP:numExposures", "FLIP:alphaMaxError"})
        EXPECT_EQ(map.spec().find_attribute(name), nullptr) << name;
    EXPECT_THAT(map.spec().get_string_attribute("FLIP:warnings"), HasSubstr("white in both"));
}

TEST(Annotate, AlphaIsSaidWhereItWasCompared) {
    const auto spec = make_spec(4, 4, {"R", "G", "B", "A"});
    FlipOptions options;
    options.alpha = AlphaPolicy::Error;
    const auto map =
        ToneAlgo::ldr_flip(constant(spec, {1, 1, 1, 1}), constant(spec, {1, 1, 1, 0.5f}), options);
    EXPECT_EQ(number(map, "alphaMaxError"), 0.5f);
    EXPECT_EQ(number(map, "alphaMeanError"), 0.5f);
}

} // namespace
} // namespace tonetool
