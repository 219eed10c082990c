// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/attribute/cryptomatte.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "attribute/small_render.h"

namespace tonetool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Warnings about a manifest, and the names that the table has.
struct Told {
    std::vector<std::string> warnings, names;
};
Told told(const Render& render, const std::string& folder = "") {
    ImageBuf image = render.image();
    const UnreadFile file(folder.empty() ? "" : write_file(folder + "/a.exr", image));
    const ImageBuf& used = folder.empty() ? image : file.image;
    const AttributeResult result = attributed(used, used);
    Told told{result.warnings, {}};
    if (!result.mattes.empty())
        for (const AttributedMatte& matte : result.mattes[0].mattes)
            told.names.push_back(matte.name);
    std::sort(told.names.begin(), told.names.end());
    return told;
}

std::vector<std::string> unnamed() {
    std::vector<std::string> names;
    for (const char* name : {"ball", "box", "floor"})
        names.push_back(OIIO::Strutil::fmt::format("<{:08x}>", metrics::cryptomatte_id(name)));
    std::sort(names.begin(), names.end());
    return names;
}

TEST(Manifests, InTheHeaderOrBesideTheFile) {
    EXPECT_THAT(told(Render()).names, ElementsAre("ball", "box", "floor"));
    const Folder folder;
    std::filesystem::create_directory(folder / "manifests");
    std::ofstream(folder / "manifests/a.json") << Render().manifest();
    Render beside;
    beside.manifest_file = "manifests/a.json";
    const Told good = told(beside, folder / "");
    EXPECT_THAT(good.names, ElementsAre("ball", "box", "floor"));
    EXPECT_THAT(good.warnings, IsEmpty());
}

TEST(Manifests, PathsThatLeaveTheFolderAreRefused) {
    const Folder folder;
    std::filesystem::create_directory(folder / "images");
    std::ofstream(folder / "a.json") << Render().manifest();
    Render render;
    for (const std::string& path :
         {std::string("../a.json"), folder / "a.json", std::string("x/../../a.json"),
          std::string("..\\a.json"), std::string("../../../../etc/passwd")}) {
        render.manifest_file = path;
        const Told result = told(render, folder / "images");
        EXPECT_EQ(result.names, unnamed()) << path;
        ASSERT_EQ(result.warnings.size(), 2u) << path; // of each side
        EXPECT_THAT(result.warnings[0], HasSubstr("must lie in the folder of the image"));
    }
    render.manifest_file = "nothing.json";
    EXPECT_THAT(told(render, folder / "images").warnings[0], HasSubstr("is no file"));
    ASSERT_EQ(mkfifo((folder / "images/pipe").c_str(), 0600), 0);
    render.manifest_file = "pipe"; // would wait for ever
    EXPECT_THAT(told(render, folder / "images").warnings[0], HasSubstr("is no file"));
}

TEST(Manifests, WhatIsNoManifestLeavesNamesUnknown) {
    Render render;
    for (const char* text : {"{", "[]", "[\"a\"]", "{\"a\": 1}", "{\"a\": {\"b\": \"1\"}}",
                             "{\"a\": [\"1\"]}", "null", "\"a\"", "{\"a\": \"0\"", "\xff\xfe"}) {
        render.attributes["manifest"] = text;
        const Told result = told(render);
        EXPECT_EQ(result.names, unnamed()) << text;
        ASSERT_FALSE(result.warnings.empty()) << text;
        EXPECT_THAT(result.warnings[0], HasSubstr("no JSON object of names and ids")) << text;
    }
    render.attributes["manifest"] = std::string(200000, '[');
    EXPECT_EQ(told(render).names, unnamed());
}

TEST(Manifests, IdsAreLookedAt) {
    Render render;
    render.attributes["manifest"] = R"({"ball": "no id", "floor": "123456789", "box": ""})";
    EXPECT_THAT(told(render).warnings[0], HasSubstr("3 id(s) that are no hexadecimal numbers"));
    render.attributes["manifest"] =
        OIIO::Strutil::fmt::format(R"({{"cube": "{:08x}"}})", metrics::cryptomatte_id("box"));
    const Told other = told(render);
    EXPECT_THAT(other.names, testing::Contains("cube")); // what the file says, with a warning
    EXPECT_THAT(other.warnings[0], HasSubstr("1 name(s) another id than their hash, first "
                                             "\"cube\""));
    // Of a name that is there twice the last counts.
    render.attributes["manifest"] = OIIO::Strutil::fmt::format(
        R"({{"box": "00000001", "box": "{:08x}"}})", metrics::cryptomatte_id("box"));
    EXPECT_THAT(told(render).names, testing::Contains("box"));
}

TEST(Manifests, AMillionNames) {
    std::string text = "{";
    for (int i = 0; i < 1000000; ++i)
        text += "\"n" + std::to_string(i % 900000) + "\":\"" +
                OIIO::Strutil::fmt::format("{:08x}", i) + "\",";
    text += Render().manifest().substr(1);
    Render render;
    render.attributes["manifest"] = text;
    const ImageBuf many = render.image(), few = Render().image();
    const auto begin = std::chrono::steady_clock::now();
    const AttributeResult result = attributed(few, many);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
    ASSERT_EQ(result.manifest_only.size(), 1u);
    EXPECT_EQ(result.manifest_only[0].test.size(), 1000u);
    EXPECT_THAT(result.warnings,
                testing::Contains(HasSubstr("900000 name(s) of View.CryptoObject are in one")));
}

// An id for each pixel: of a scene with many objects, or of ids that were filtered like colours.
ImageBuf with_many_ids(const Render& render) {
    ImageBuf image = render.image();
    uint32_t id = 0x3f000000;
    for (ImageBuf::Iterator<float> p(image); !p.done(); ++p, ++id) {
        float bits = 0;
        std::memcpy(&bits, &id, sizeof bits);
        p[image.nchannels() - 4] = bits;
    }
    return image;
}

TEST(Manifests, ManyIdsAreToldInPartAndRefusedIfTheManifestDoesNotKnowThem) {
    Render render;
    EXPECT_THAT(refused(with_many_ids(render), with_many_ids(render)),
                HasSubstr("1536 ids of View.CryptoObject are not in its manifest, and 0 are"));
    render.attributes["manifest"] = "{}";
    const AttributeResult result = attributed(with_many_ids(render), with_many_ids(render));
    EXPECT_EQ(result.mattes[0].mattes.size(), 1000u);
    EXPECT_THAT(result.warnings,
                ElementsAre("of View.CryptoObject the first 1000 of 1536 rows are told"));
}

TEST(Manifests, OtherHashesAreNotLookedAt) {
    for (const char* name : {"hash", "conversion"}) {
        Render render;
        render.attributes[name] = "other";
        const Told result = told(render);
        EXPECT_THAT(result.names, IsEmpty());
        EXPECT_THAT(result.warnings[0], HasSubstr("View.CryptoObject is not looked at"));
    }
}

TEST(AttributeGoldens, EveryOddityOfCryptomatte) {
    const char* shared = std::getenv("SHARED_DIR");
    const std::string folder = std::string(shared ? shared : "") + "/golden/suites/tiny";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "no golden/suites/tiny below SHARED_DIR (\"" << (shared ? shared : "")
                     << "\")";
    const UnreadFile reference(folder + "/ref.exr"), test(folder + "/test.exr"),
        map(folder + "/map.exr");
    AttributeResult result;
    std::string error;
    ASSERT_TRUE(
        ToneAlgo::attribute(result, {&reference.image}, {&test.image}, error, {}, &map.image))
        << error;
    EXPECT_THAT(result.warnings, IsEmpty());
    const auto expected = nlohmann::json::parse(std::ifstream(folder + "/expected.json"));
    ASSERT_EQ(result.mattes.size(), 1u);
    EXPECT_EQ(result.mattes[0].mattes.size(), expected.size());
    double mass = 0;
    for (const AttributedMatte& row : result.mattes[0].mattes) {
        ASSERT_TRUE(expected.contains(row.name)) << row.name;
        const auto& wanted = expected[row.name];
        EXPECT_NEAR(row.pixels_reference, wanted["pixels_reference"].get<double>(), 1e-6);
        EXPECT_NEAR(row.pixels_test, wanted["pixels_test"].get<double>(), 1e-6);
        EXPECT_NEAR(row.mass, wanted["mass"].get<double>(), 1e-6) << row.name;
        mass += row.mass;
    }
    EXPECT_NEAR(mass, 1, 1e-9);
}

} // namespace
} // namespace tonetool
