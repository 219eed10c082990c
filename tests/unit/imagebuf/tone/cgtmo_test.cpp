// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/cgtmo.h"

#include <gtest/gtest.h>

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
