// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/plan.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <unistd.h>

#include "chain/language/registry.h"
#include "runs/runs.h"

namespace tonetool::recipe {
namespace {

// A recipe beside the test images is not to be written; its inputs have whole names.
class Plan : public testing::TestWithParam<const char*> {
protected:
    Plan()
        : m_file((std::filesystem::temp_directory_path() /
                  ("tonetool_plan." + std::to_string(getpid()) + ".tone"))
                     .string()) {}
    ~Plan() override { std::filesystem::remove(m_file); }

    Source source(const std::string& chain) {
        std::ofstream(m_file) << "tonetool 1\n$T = " TESTIMAGES_DIR "\n" << chain << "\n";
        return {m_file, {}};
    }

private:
    std::string m_file;
};

// What is planned is what is made.
using Planned = Plan;
TEST_P(Planned, IsWhatIsMade) {
    const Source recipe = source(GetParam());
    const auto planned = planned_header(recipe);
    ASSERT_TRUE(planned.has_value());
    const OIIO::ImageSpec made = picture_of(recipe)->subimages.front().spec();
    EXPECT_EQ(planned->roi(), made.roi());
    EXPECT_EQ(planned->roi_full(), made.roi_full());
    EXPECT_EQ(planned->format, made.format);
}

INSTANTIATE_TEST_SUITE_P(
    Chains, Planned,
    testing::Values("$T/cornell_ref.exr $T/cornell_test.exr --hdrflip",
                    "$T/cornell_ref.exr $T/cornell_test.exr --hdrflip:exposuremap=stops --mulc 2",
                    "$T/srgb8.png $T/srgb8.png --ldrflip:ppd=40", "$T/plain.exr --exposure 2",
                    "$T/gallery_ref.exr --tonemap:curve=hable:method=mean --attrib a b",
                    "$T/srgb16.png --addc 0.1 --label x", "$T/datawindow.exr --calibrate",
                    "$T/overscan.exr --abs --powc 2 --clamp", "$T/plain.exr $T/rgba.exr --mulc 2",
                    "$T/y_only.exr --subc 1 --divc 2 --maxc 0 --minc 1 --absdiffc 1",
                    "$T/rgba.exr --saturate 0 --invert --ccmatrix 1,0,0,0,1,0,0,0,1",
                    "$T/plain.exr --iscolorspace sRGB --eraseattrib x --caption c --keyword k "
                    "--sattrib s t --echo text",
                    "--colorconfig $T/../ocio/tonetool.ocio $T/plain.exr --colorconvert "
                    "ACES2065-1 ACEScg --ociodisplay sRGB agx"));

// The chain "a command with arguments" for a row of the registry.
std::string chain_of(const chain::Command& row) {
    const std::map<std::string, std::string> examples = {
        {"VALUES", "0.5"},
        {"SCALE", "0.5"},
        {"STOPS", "1"},
        {"NAME", "name"},
        {"VALUE", "value"},
        {"REGEX", "n.*"},
        {"TEXT", "text"},
        {"KEYWORD", "word"},
        {"COLORSPACE", "ACEScg"},
        {"SRC", "ACES2065-1"},
        {"DST", "ACEScg"},
        {"LOOK", "'ACES 1.3 Reference Gamut Compression'"},
        {"DISPLAY", "sRGB"},
        {"VIEW", "agx"},
        {"MATRIXVALS", "1,0,0,0,1,0,0,0,1"},
        {"FILE", "$T/../ocio/tonetool.ocio"}};
    std::string words = "--" + row.names.front();
    for (const std::string& argument : row.args)
        words += " " + examples.at(argument);
    return words;
}

// A row that says so keeps the header of what is on the stack and of what is read after it.
TEST_F(Plan, CommandsKeepHeadersAsTheirRowsSay) {
    runs::know_all_commands();
    for (const chain::Command& row : chain::all_commands()) {
        if (!row.keeps_header)
            continue;
        const std::string image = "$T/datawindow.exr", own = chain_of(row);
        const std::string config = "--colorconfig $T/../ocio/tonetool.ocio ";
        const Source recipe =
            source(config + (row.pops == 0 ? own + " " + image : image + " " + own));
        const auto planned = planned_header(recipe);
        ASSERT_TRUE(planned.has_value()) << own;
        const OIIO::ImageSpec made = picture_of(recipe)->subimages.front().spec();
        EXPECT_EQ(planned->roi(), made.roi()) << own;
        EXPECT_EQ(planned->roi_full(), made.roi_full()) << own;
        EXPECT_EQ(planned->nchannels, made.nchannels) << own;
        EXPECT_EQ(planned->format, made.format) << own;
    }
}

using Unplanned = Plan;
TEST_P(Unplanned, IsToBeRun) {
    EXPECT_FALSE(planned_header(source(GetParam())).has_value());
}

INSTANTIATE_TEST_SUITE_P(
    Chains, Unplanned,
    testing::Values("$T/plain.exr --resize 50%", "$T/nosuch.exr", "$T/plain.exr --hdrflp",
                    "$T/plain.exr -o x.exr", "$T/plain.exr --mulc", "--mulc 2",
                    "$T/plain.exr --mulc {TOP.width}", "$T/plain.#.exr --mulc 2",
                    "$T/plain.exr --if 0 --mulc 2 --endif", "$T/deep.exr --mulc 2", "",
                    "$T/white.exr $T/black.exr --hdrflip:fail=0.1",
                    "$T/cornell_ref.exr $T/plain.exr --hdrflip", "$T/plain.exr --mulc:nosuch=1 2",
                    "-a $T/plain.exr --mulc 2"));

// Headers are enough.
TEST_F(Plan, ReadsNoPixels) {
    const Source recipe = source("$T/truncated.exr --exposure 1");
    EXPECT_TRUE(planned_header(recipe).has_value());
    EXPECT_THROW((void)picture_of(recipe), RecipeError);
}

} // namespace
} // namespace tonetool::recipe
