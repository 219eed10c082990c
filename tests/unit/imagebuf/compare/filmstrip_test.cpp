// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "images.h"
#include "tonetool/flip.h"

namespace tonetool {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using ToneAlgo::FilmstripOptions;
using ToneAlgo::flip_filmstrip;

HdrFlipOptions exposures(int n) {
    HdrFlipOptions options;
    options.start_exposure = -2;
    options.stop_exposure = 2;
    options.num_exposures = n;
    return options;
}

ImageBuf strip(const HdrFlipOptions& options, const FilmstripOptions& look,
               FlipResult* result = nullptr) {
    const auto reference = noise(48, 32, 1);
    ImageBuf out;
    EXPECT_TRUE(flip_filmstrip(out, reference, disturbed(reference, 0.5, 2), options, look, result))
        << out.geterror();
    return out;
}

FilmstripOptions look(int thumb_width, int columns, const std::string& font = "") {
    FilmstripOptions out;
    out.thumb_width = thumb_width;
    out.max_columns = columns;
    out.font = font;
    return out;
}

TEST(Filmstrip, GrowsByAColumnPerExposure) {
    const int margin = 2; // a thirtieth of 64
    const auto two = strip(exposures(2), look(64, 9));
    for (int n : {1, 3, 5, 9})
        EXPECT_EQ(strip(exposures(n), look(64, 9)).spec().width - two.spec().width,
                  (n - 2) * (64 + margin))
            << n;
    EXPECT_EQ(strip(exposures(9), look(64, 2)).spec().width, two.spec().width);
    EXPECT_EQ(strip(exposures(40), look(64, 2)).spec().height, two.spec().height);
}

TEST(Filmstrip, IsAPictureForTheScreen) {
    FlipResult result;
    const auto out = strip(exposures(3), look(64, 9), &result);
    EXPECT_EQ(out.nchannels(), 3);
    EXPECT_EQ(out.spec().get_string_attribute("oiio:ColorSpace"), "sRGB");
    for (float v : values(out)) {
        ASSERT_GE(v, 0.0f);
        ASSERT_LE(v, 1.0f);
    }
    EXPECT_EQ(result.summary.exposures.size(), 3u);
    EXPECT_GT(result.summary.pool.mean, 0.0);
    EXPECT_TRUE(result.exposures.empty());
}

TEST(Filmstrip, AMissingFontLeavesTheLabelsOutAndSaysSo) {
    FlipResult labelled, bare;
    const auto with = strip(exposures(3), look(64, 9), &labelled);
    const auto without = strip(exposures(3), look(64, 9, "no/such/font.ttf"), &bare);
    EXPECT_THAT(bare.summary.warnings,
                Contains(AnyOf(HasSubstr("no font file \"no/such/font.ttf\""))));
    ASSERT_EQ(with.roi(), without.roi()) << "the layout does not depend on the font";
    if (!labelled.summary.warnings.empty())
        GTEST_SKIP() << labelled.summary.warnings[0];
    EXPECT_GT(largest_difference(with, without), 0.1) << "there are labels";
}

TEST(Filmstrip, SaysWhatIsWrong) {
    const auto image = noise(8, 8, 1);
    const struct {
        HdrFlipOptions options;
        FilmstripOptions look;
        const char* words;
    } cases[] = {{exposures(2), look(31, 3), "width is 31: must be 32 to 4096"},
                 {exposures(2), look(4097, 3), "width is 4097"},
                 {exposures(2), look(64, 0), "columns is 0: must be at least 1"},
                 {exposures(0), look(64, 3), "numExposures is 0"}};
    for (const auto& c : cases) {
        ImageBuf out = image;
        EXPECT_FALSE(flip_filmstrip(out, image, image, c.options, c.look));
        const std::string error = out.geterror();
        EXPECT_THAT(error, HasSubstr(c.words));
        EXPECT_THAT(error, HasSubstr("flip_filmstrip: "));
        EXPECT_FALSE(out.initialized());
    }
    ImageBuf out;
    EXPECT_FALSE(flip_filmstrip(out, image, ImageBuf(), exposures(2)));
    EXPECT_THAT(out.geterror(), HasSubstr("test image: is not initialized"));
}

TEST(Filmstrip, ShowsTheWholeDisplayWindow) {
    auto spec = make_spec(20, 10, {"R", "G", "B"});
    spec.x = 10;
    spec.y = 5;
    spec.full_width = 60;
    spec.full_height = 20;
    const auto image = noise(spec, 3);
    ImageBuf out, square;
    ASSERT_TRUE(flip_filmstrip(out, image, disturbed(image, 0.3, 1), exposures(2), look(96, 9)));
    // 96 wide, a third as high: three of them are lower than three square ones.
    const auto plain = noise(20, 20, 4);
    ASSERT_TRUE(flip_filmstrip(square, plain, plain, exposures(2), look(96, 9)));
    EXPECT_EQ(square.spec().height - out.spec().height, 3 * (96 - 32));
}

} // namespace
} // namespace tonetool
