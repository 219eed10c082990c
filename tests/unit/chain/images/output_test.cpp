// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/output.h"

#include <gmock/gmock.h>

#include "text/error.h"

namespace tonetool::chain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ImagePtr image(int channels) {
    return Image::created("made", OIIO::ImageBuf(OIIO::ImageSpec(4, 4, channels, OIIO::TypeFloat)));
}

class Output : public testing::Test {
protected:
    Writer writer(bool lenient = false) {
        return {"tonetool --words", lenient, &types,
                [this](const std::string& text) { told.push_back(text); }, &matched};
    }
    std::string file(const char* name) { return testing::TempDir() + name; }
    ReadTypes types;
    Strings told;
    std::set<std::string> matched;
};

TEST_F(Output, TypesAreNamedForAllOrForSomeChannels) {
    OutputSettings settings;
    settings.set_type("half", false);
    EXPECT_EQ(settings.type->type, OIIO::TypeHalf);
    settings.set_type("R=float,Z=uint32", false);
    EXPECT_EQ(settings.type_of_channel.at("Z").type, OIIO::TypeUInt32);
    EXPECT_EQ(settings.type->type, OIIO::TypeHalf);
    EXPECT_THROW(settings.set_type("halves", false), CommandError);
    EXPECT_THROW(settings.set_type("R=halves", false), CommandError);
    EXPECT_THROW(settings.set_type("=half", false), CommandError);
    EXPECT_NO_THROW(settings.set_type("R=halves", true));
}

TEST_F(Output, TheFileHasTheTypesThatWereAskedFor) {
    OutputSettings settings;
    settings.set_type("half", false);
    settings.set_type("B=float,Q=float", false);
    bool before = false;
    write_output(*image(3), file("typed.exr"), settings, writer(), [&] { before = true; });
    EXPECT_TRUE(before);
    const auto input = OIIO::ImageInput::open(file("typed.exr"));
    ASSERT_TRUE(input);
    EXPECT_THAT(input->spec().channelformats,
                ElementsAre(OIIO::TypeHalf, OIIO::TypeHalf, OIIO::TypeFloat));
    EXPECT_THAT(matched, ElementsAre("B"));
    EXPECT_THAT(input->spec().get_string_attribute("Software"), HasSubstr("tonetool --words"));
}

TEST_F(Output, WhatWasReadGivesTheTypeOfWhatIsComputed) {
    EXPECT_EQ(types.of(image(1)->part(), false).type, OIIO::TypeFloat);
    types.note(*Image::open(TESTIMAGES_DIR "/plain.exr"));
    EXPECT_EQ(types.of(image(1)->part(), false).type, types.widest->type);
}

TEST_F(Output, ChannelsThatDoNotFitAreSaid) {
    write_output(*image(5), file("five.jpg"), {}, writer(), [] {});
    EXPECT_THAT(told, ElementsAre(HasSubstr("Can't save 5 channels to jpeg")));
}

TEST_F(Output, AFileThatCannotBeWrittenIsAnError) {
    EXPECT_THROW(write_output(*image(3), file("nosuch/a.exr"), {}, writer(), [] {}), CommandError);
    EXPECT_THROW(write_output(*image(3), file("a.nosuch"), {}, writer(), [] {}), CommandError);
}

TEST_F(Output, CompressionsAreKnown) {
    EXPECT_NO_THROW(check_compression("dwaa:45"));
    EXPECT_THROW(check_compression("zipp"), CommandError);
    EXPECT_THROW(check_compression("dwaa:high"), CommandError);
}

} // namespace
} // namespace tonetool::chain
