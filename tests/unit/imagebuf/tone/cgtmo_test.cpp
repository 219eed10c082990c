// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/cgtmo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
using ToneAlgo::cg_tmo;

std::vector<float> pixels(const ImageBuf& image, const ROI& roi) {
    std::vector<float> out(size_t(roi.width()) * size_t(roi.height()) * size_t(roi.nchannels()));
    EXPECT_TRUE(image.get_pixels(roi, OIIO::TypeFloat, out.data())) << image.geterror();
    return out;
}

TEST(CgTmo, DependsOnNeitherRegionNorThreads) {
    const ImageBuf scene(TESTIMAGES_DIR "/cornell_ref.exr");
    for (const char* filter : {"guided", "bilateral", "wls", "none"})
        for (const char* preset : {"default", "paper"}) {
            CgTmoOptions options;
            options.filter = filter;
            options.preset = preset;
            const ImageBuf all = cg_tmo(scene, options, nullptr, {}, 1);
            ASSERT_FALSE(all.has_error()) << all.geterror();
            const ROI part(20, 71, 33, 60, 0, 1, 0, all.nchannels());
            const ImageBuf some = cg_tmo(scene, options, nullptr, part, 3);
            ASSERT_FALSE(some.has_error()) << some.geterror();
            EXPECT_EQ(some.roi(), part);
            EXPECT_EQ(pixels(some, part), pixels(all, part)) << filter << " " << preset;
        }
}

// A lamp beyond the largest half is Inf in the file, in one channel or in all: as bright as it
// gets, and none of the numbers that the curve follows from.
TEST(CgTmo, InfinityIsLightAndNaNIsBlack) {
    const ImageBuf scene(TESTIMAGES_DIR "/cornell_ref.exr");
    constexpr float inf = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<std::array<float, 3>> colors = {
        {inf, inf, inf}, {2e4f, 2e4f, inf}, {nan, nan, nan}, {-inf, -inf, -inf}};
    ImageBuf spoiled = scene.copy(scene.spec().format);
    const int red = scene.spec().channelindex("ViewLayer.Combined.R");
    ASSERT_GE(red, 0);
    std::vector<float> pixel(size_t(scene.nchannels()));
    for (int i = 0; i < int(colors.size()); ++i) {
        spoiled.getpixel(40 + 5 * i, 50, pixel.data());
        std::copy(colors[size_t(i)].begin(), colors[size_t(i)].end(), pixel.begin() + red);
        spoiled.setpixel(40 + 5 * i, 50, pixel.data());
    }
    for (const char* filter : {"guided", "bilateral", "wls", "none"})
        for (const char* preset : {"default", "paper", "classic"}) {
            SCOPED_TRACE(std::string(filter) + " " + preset);
            CgTmoOptions options;
            options.filter = filter;
            options.preset = preset;
            CgTmoSummary summary;
            const ImageBuf out = cg_tmo(spoiled, options, &summary);
            ASSERT_FALSE(out.has_error()) << out.geterror();
            EXPECT_EQ(summary.nonfinite, 4);
            EXPECT_LT(summary.maximum, 1e3);
            for (int i = 0; i < int(colors.size()); ++i) {
                out.getpixel(40 + 5 * i, 50, pixel.data());
                const std::vector<float> rgb(pixel.begin() + red, pixel.begin() + red + 3);
                if (i < 2)
                    EXPECT_GT(*std::min_element(rgb.begin(), rgb.end()), 0.85f) << i;
                else
                    EXPECT_EQ(rgb, std::vector<float>(3, 0.0f)) << i;
            }
        }
}

TEST(CgTmo, NumbersOfWeightedLeastSquaresAreForThemAlone) {
    const ImageBuf scene(TESTIMAGES_DIR "/cornell_ref.exr");
    CgTmoOptions options;
    options.wlslambda = 1;
    ImageBuf out = cg_tmo(scene, options);
    EXPECT_NE(out.geterror().find("wlslambda is of filter=wls, and this is filter=guided"),
              std::string::npos);
    options.filter = "wls";
    EXPECT_FALSE(cg_tmo(scene, options).has_error());
    options.wlslambda = 101;
    EXPECT_TRUE(cg_tmo(scene, options).has_error());
    options.wlslambda.reset();
    options.wlsalpha = -0.1;
    EXPECT_TRUE(cg_tmo(scene, options).has_error());
}

} // namespace
} // namespace tonetool
