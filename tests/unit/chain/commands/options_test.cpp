// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/options.h"

#include <gmock/gmock.h>

#include "flip/exposures.h"
#include "flip/filters.h"
#include "imagebuf/options/cgtmo_options.h"
#include "imagebuf/options/flip_options.h"
#include "imagebuf/options/tone_options.h"
#include "text/error.h"

namespace tonetool::chain {

// A struct as a command may have it. To add an option is to add a member and its row.
struct Lens {
    double focal = 50;
    std::optional<int> blades;
    bool flare = true;
    std::string mount = "pl";
    std::vector<std::string> filters;
};

template <class See>
void describe(const Lens&, See&& see) {
    see(option("focal", &Lens::focal, "focal length in mm; 0: orthographic")
            .within(8, 800)
            .zero_too());
    see(option("blades", &Lens::blades, "blades of the aperture").within(3, 20).unset("round"));
    see(option("flare", &Lens::flare, "render the flare"));
    see(option("mount", &Lens::mount, "mount").one_of({"pl", "ef"}));
    see(option("filters", &Lens::filters, "filters in front").shown_as("NAME,..."));
}

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Command lens_row() {
    Command row;
    row.names = {"lens"};
    row.modifiers = modifiers_of<Lens>();
    return row;
}

Lens read(const std::string& word) {
    static const Command row = lens_row();
    Lens lens;
    read_options(Call(row, parse_token(word), {}), lens);
    return lens;
}

std::string error_of(const std::string& word) {
    try {
        (void)read(word);
        return "";
    } catch (const CommandError& error) {
        return error.what();
    }
}

TEST(Options, ARowIsAllThatAModifierNeeds) {
    std::vector<std::string> shown;
    for (const Modifier& row : modifiers_of<Lens>())
        shown.push_back(row.key + "=" + row.hint + " " + row.help);
    EXPECT_THAT(shown, ElementsAre("focal=X focal length in mm, 8 to 800; 0: orthographic (50)",
                                   "blades=N blades of the aperture, 3 to 20 (round)",
                                   "flare=0|1 render the flare (1)", "mount=pl|ef mount (pl)",
                                   "filters=NAME,... filters in front"));
}

TEST(Options, AreReadAndOthersKeepTheirDefaults) {
    const Lens lens = read("--lens:focal=0:blades=7:mount=ef:filters=nd,uv");
    EXPECT_EQ(lens.focal, 0);
    EXPECT_EQ(lens.blades, 7);
    EXPECT_TRUE(lens.flare);
    EXPECT_EQ(lens.mount, "ef");
    EXPECT_THAT(lens.filters, ElementsAre("nd", "uv"));
    EXPECT_FALSE(read("--lens").blades);
    EXPECT_FALSE(read("--lens:flare=0").flare);
}

TEST(Options, OutOfRangeIsRefusedByCommandLineAndLibrary) {
    EXPECT_THAT(error_of("--lens:focal=801"), HasSubstr("focal"));
    EXPECT_THAT(error_of("--lens:blades=2"), HasSubstr("3 to 20"));
    EXPECT_THAT(error_of("--lens:mount=pk"), HasSubstr("pl, ef"));
    Lens lens;
    EXPECT_EQ(options_fault(lens), "");
    lens.focal = 7;
    EXPECT_EQ(options_fault(lens), "focal is 7: must be 8 to 800");
    lens.focal = 0;
    lens.mount = "pk";
    EXPECT_THAT(options_fault(lens), HasSubstr("unknown mount \"pk\""));
    lens.mount = "pl";
    lens.blades = 21;
    EXPECT_EQ(options_fault(lens), "blades is 21: must be 3 to 20");
}

TEST(Options, RangesAreSaid) {
    const auto said = [](double low, double high) {
        return option("focal", &Lens::focal, "x").within(low, high).meaning();
    };
    EXPECT_EQ(said(-126, 127), "x, -126 to 127");
    EXPECT_EQ(said(0, 4), "x, 0 to 4");
    EXPECT_EQ(said(1e-30, 1), "x, above 0, to 1");
    EXPECT_EQ(option("focal", &Lens::focal, "x").positive().meaning(), "x, above 0");
}

// Every row of every table: a name, a text of its own, and a default that is valid.
template <class Options>
void check_table() {
    std::vector<std::string> keys;
    describe(Options(), [&](const auto& row) {
        EXPECT_EQ(row.fault(Options()), "") << row.key;
        EXPECT_FALSE(row.text.empty()) << row.key;
        EXPECT_NE(row.text.back(), '.') << row.key;
        EXPECT_EQ(std::count(keys.begin(), keys.end(), row.key), 0) << row.key;
        keys.emplace_back(row.key);
    });
    EXPECT_FALSE(keys.empty());
}

TEST(Options, TablesAreComplete) {
    check_table<CgTmoOptions>();
    check_table<FlipOptions>();
    check_table<HdrFlipOptions>();
    check_table<CalibrationOptions>();
    check_table<TonemapOptions>();
    check_table<LutOptions>();
    check_table<LightOptions>();
    EXPECT_EQ(options_fault([] {
                  LutOptions odd;
                  odd.size = 1;
                  return odd;
              }()),
              "size is 1: must be 2 to 65536");
}

TEST(Options, LimitsAreThoseOfTheAlgorithms) {
    EXPECT_EQ(kPpdRange.low, flip::kMinPixelsPerDegree);
    EXPECT_EQ(kPpdRange.high, flip::kMaxPixelsPerDegree);
    EXPECT_EQ(kStopsRange.low, flip::kMinStops);
    EXPECT_EQ(kStopsRange.high, flip::kMaxStops);
    describe(HdrFlipOptions(), [](const auto& row) {
        if (std::string(row.key) == "numExposures")
            EXPECT_EQ(row.range->high, flip::kMaxExposures);
    });
}

} // namespace
} // namespace tonetool::chain
