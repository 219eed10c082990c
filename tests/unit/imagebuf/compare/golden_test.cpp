// SPDX-License-Identifier: BSD-3-Clause
// HDR-FLIP and LDR-FLIP against error maps of the published C++ program (see the MANIFEST beside
// the goldens). Every line of a results.jsonl is one comparison.
//
// That program computes in float and is itself up to 1.6e-5 away from the double-precision value.
// Where a map of ours is farther than the bound from a golden, the reference implementation in
// double precision decides: ours must be within the bound of it. The lines where this happens, and
// to how many pixels at most, are listed; a pixel more is a failure.
#include <gtest/gtest.h>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "flip/filters.h"
#include "kernels/flip_reference.h"
#include "tonemap/rational.h"
#include "tonetool/flip.h"

namespace {

using nlohmann::json;
using OIIO::ImageBuf;

struct Golden {
    std::string root; ///< paths in the line are relative to it
    json line;
};

// The program runs in float, whose noise the metric amplifies near zero: E ~ h^0.7 has infinite
// slope at 0, and one ulp of L makes 2e-5 to 8e-5 there.
constexpr double kClose = 1e-5, kCloseBelow = 1e-4, kSmallError = 0.01;
constexpr double kExposure = 1e-5, kMean = 2e-6, kQuartile = 2e-4;
constexpr double kExposureMapShare = 0.999, kExposureMapFrom = 0.001;

const std::map<std::string, int> kGoldenIsOff = {{"gallery_16_ldr", 13}};

std::vector<float> channel(const ImageBuf& image, int c) {
    OIIO::ROI roi = image.roi();
    roi.chbegin = c;
    roi.chend = c + 1;
    std::vector<float> out(size_t(roi.width()) * size_t(roi.height()));
    EXPECT_TRUE(image.get_pixels(roi, OIIO::TypeFloat, out.data()));
    return out;
}

tonetool::HdrFlipOptions parse(const std::string& options) {
    tonetool::HdrFlipOptions out;
    std::istringstream words(options);
    for (std::string key, value; words >> key && key != "--ldr" && words >> value;)
        if (key == "--tm")
            out.curve.name = value;
        else if (key == "--n")
            out.num_exposures = std::stoi(value);
        else if (key == "--cstart")
            out.start_exposure = std::stod(value);
        else if (key == "--cstop")
            out.stop_exposure = std::stod(value);
        else if (key == "--ppd")
            out.ppd = std::stod(value);
        else
            ADD_FAILURE() << "unknown option " << key;
    out.want_exposure_map = true;
    return out;
}

// The double-precision reference implementation's map of what a comparison saw.
std::vector<double> map_by_reference(const ImageBuf& reference, const ImageBuf& test,
                                     const tonetool::FlipSummary& summary) {
    std::vector<float> planes[2][3];
    tonetool::kernels::ConstRgb views[2];
    for (int side = 0; side < 2; ++side) {
        const ImageBuf& image = side == 0 ? reference : test;
        tonetool::ColorChoice choice;
        std::string error;
        EXPECT_TRUE(tonetool::ToneAlgo::find_color(image.spec(), {}, choice, error)) << error;
        const int channels[3] = {choice.r, choice.g, choice.b};
        views[side] = {{}, image.spec().width, image.spec().width, image.spec().height};
        for (int c = 0; c < 3; ++c) {
            planes[side][c] = channel(image, channels[c]);
            views[side].plane[c] = planes[side][c].data();
        }
    }
    tonetool::kernels::ToneCurve curve;
    if (summary.hdr)
        curve = *tonetool::tonemap::rational_curve(summary.tonemapper);
    return tonetool::kernels::hdr_flip_reference(
        views[0], views[1], tonetool::flip::make_taps(summary.ppd), curve,
        summary.hdr ? summary.exposures : std::vector<double>{0.0}, nullptr);
}

struct Maps {
    std::vector<float> ours, golden;
    std::function<std::vector<double>()> reference; ///< slow: only made when it must decide
};

void compare_maps(const Maps& maps, const std::string& name) {
    ASSERT_EQ(maps.ours.size(), maps.golden.size());
    double worst = 0, worst_below = 0, sum = 0, golden_sum = 0;
    std::vector<size_t> beyond;
    for (size_t i = 0; i < maps.ours.size(); ++i) {
        const double golden = maps.golden[i], difference = std::abs(maps.ours[i] - golden);
        double& largest = golden >= kSmallError ? worst : worst_below;
        largest = std::max(largest, difference);
        if (golden >= kSmallError && difference > kClose)
            beyond.push_back(i);
        sum += maps.ours[i];
        golden_sum += golden;
    }
    const auto n = double(maps.ours.size());
    EXPECT_LE(worst_below, kCloseBelow);
    EXPECT_NEAR(sum / n, golden_sum / n, kMean);
    const auto allowed = kGoldenIsOff.find(name);
    EXPECT_LE(beyond.size(), allowed == kGoldenIsOff.end() ? 0u : size_t(allowed->second))
        << "worst " << worst;
    const auto exact = beyond.empty() ? std::vector<double>{} : maps.reference();
    for (size_t i : beyond)
        EXPECT_LE(std::abs(maps.ours[i] - exact[i]), kClose) << "pixel " << i;
    std::printf("  worst %.3g (below 0.01: %.3g), beyond the bound %zu, mean off by %.3g\n", worst,
                worst_below, beyond.size(), sum / n - golden_sum / n);
}

void compare_exposures(const tonetool::FlipResult& result, const ImageBuf& golden,
                       const std::vector<float>& error) {
    const auto n = result.summary.exposures.size();
    const auto index = channel(result.exposure_index, 0);
    const auto expected = channel(golden, golden.spec().channelindex("exposure"));
    size_t same = 0, counted = 0;
    for (size_t i = 0; i < index.size(); ++i) {
        if (error[i] <= float(kExposureMapFrom))
            continue;
        ++counted;
        same += std::lround(expected[i] * double(n - 1)) == std::lround(index[i]);
    }
    EXPECT_GE(double(same), kExposureMapShare * double(counted));
    std::printf("  exposure map: %zu of %zu differ\n", counted - same, counted);
}

void compare_summary(const tonetool::FlipSummary& summary, const json& line) {
    EXPECT_NEAR(summary.pool.weighted_q1, line["weighted_q1"], kQuartile);
    EXPECT_NEAR(summary.pool.weighted_median, line["weighted_median"], kQuartile);
    EXPECT_NEAR(summary.pool.weighted_q3, line["weighted_q3"], kQuartile);
    EXPECT_NEAR(summary.pool.max, line["max"], kClose);
    EXPECT_NEAR(summary.ppd, line["ppd"], 1e-5);
    if (line["hdr"] == 0)
        return;
    EXPECT_EQ(int(summary.exposures.size()), line["numExposures"].get<int>());
    EXPECT_NEAR(summary.exposures.front(), line["startExposure"], kExposure);
    EXPECT_NEAR(summary.exposures.back(), line["stopExposure"], kExposure);
}

class Goldens : public testing::TestWithParam<Golden> {};

TEST_P(Goldens, MatchesPublishedProgram) {
    const auto& [root, line] = GetParam();
    const ImageBuf reference(root + line["reference"].get<std::string>());
    const ImageBuf test(root + line["test"].get<std::string>());
    const ImageBuf golden(root + line["map"].get<std::string>());
    const auto options = parse(line["options"]);
    tonetool::FlipResult result;
    const ImageBuf map = line["hdr"] == 1
                             ? tonetool::ToneAlgo::hdr_flip(reference, test, options, &result)
                             : tonetool::ToneAlgo::ldr_flip(reference, test, options, &result);
    ASSERT_FALSE(map.has_error()) << map.geterror();
    const auto expected = channel(golden, golden.spec().channelindex("flip"));
    compare_maps({channel(map, 0), expected,
                  [&] { return map_by_reference(reference, test, result.summary); }},
                 line["name"]);
    compare_summary(result.summary, line);
    if (line["hdr"] == 1)
        compare_exposures(result, golden, expected);
    if (line["reference"] == line["test"])
        EXPECT_EQ(result.summary.pool.max, 0.0) << "an image against itself must be exactly 0";
}

std::vector<Golden> read_lines(const std::string& root, const std::string& file) {
    std::vector<Golden> out;
    std::ifstream in(root + file);
    for (std::string text; std::getline(in, text);)
        if (!text.empty())
            out.push_back({root, json::parse(text)});
    return out;
}

std::string shared_dir() {
    const char* dir = std::getenv("SHARED_DIR");
    return dir ? std::string(dir) + "/" : "";
}

const auto name_of = [](const auto& info) {
    return info.param.line["name"].template get<std::string>();
};

INSTANTIATE_TEST_SUITE_P(Small, Goldens,
                         testing::ValuesIn(read_lines(TESTIMAGES_DIR "/", "golden/results.jsonl")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Shared, Goldens,
                         testing::ValuesIn(read_lines(shared_dir(), "golden/flip/results.jsonl")),
                         name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Goldens);

TEST(GoldenFiles, SmallOnesAreThere) {
    EXPECT_FALSE(read_lines(TESTIMAGES_DIR "/", "golden/results.jsonl").empty());
}

TEST(GoldenFiles, SharedOnesAreThere) {
    if (read_lines(shared_dir(), "golden/flip/results.jsonl").empty())
        GTEST_SKIP() << "no golden/flip/results.jsonl below SHARED_DIR (\"" << shared_dir()
                     << "\"): the large goldens are not compared";
}

} // namespace
