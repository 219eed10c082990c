// SPDX-License-Identifier: BSD-3-Clause
// What the headers of Radiance files and ICC profiles say of the colour.
#include <OpenImageIO/filesystem.h>
#include <cmath>
#include <gmock/gmock.h>

#include "files.h"
#include "imagebuf/pixels/radiance.h"
#include "tonetool/color_tags.h"

namespace tonetool {
namespace {

using Bytes = std::vector<unsigned char>;

TEST(RadianceExposure, IsTheProductOfAllLines) {
    const std::string start = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n",
                      end = "\n-Y 2 +X 2\nEXPOSURE=3\n";
    EXPECT_EQ(radiance_exposure(start + end), std::nullopt);
    EXPECT_EQ(radiance_exposure(start + "EXPOSURE=16\n" + end), 16);
    EXPECT_EQ(radiance_exposure(start + "EXPOSURE=2\nSOFTWARE=x\nEXPOSURE= 4e0\n" + end), 8);
    EXPECT_EQ(radiance_exposure(start + "EXPOSURE=0.5\r\n" + end), 0.5);
    for (const char* none : {"EXPOSURE=0\n", "EXPOSURE=-2\n", "EXPOSURE=nan\n", "PEXPOSURE=2\n"})
        EXPECT_EQ(radiance_exposure(start + none + end), std::nullopt) << none;
    EXPECT_EQ(radiance_exposure("EXPOSURE=2\n\n"), std::nullopt);
    EXPECT_EQ(radiance_exposure(""), std::nullopt);
}

TEST(RadianceExposure, OfAFileReplacesItsLastLine) {
    Folder folder;
    const std::string name = folder / "a.hdr";
    ASSERT_TRUE(OIIO::Filesystem::write_text_file(
        name, "#?RADIANCE\nEXPOSURE=2\nEXPOSURE=8\n\n-Y 1 +X 1\n...."));
    ImageSpec spec(1, 1, 3, OIIO::TypeFloat);
    take_whole_exposure(spec, name); // not of every image of that name
    EXPECT_EQ(stated_exposure(spec), 1);
    spec.attribute("hdr:exposure", 8.0f);
    take_whole_exposure(spec, name);
    EXPECT_EQ(stated_exposure(spec), 16);
    take_whole_exposure(spec, folder / "nosuch.hdr");
    EXPECT_EQ(stated_exposure(spec), 16);
}

void put(Bytes& to, uint32_t value, int bytes = 4) {
    for (int i = bytes - 1; i >= 0; --i)
        to.push_back(static_cast<unsigned char>(value >> (8 * i)));
}

void put(Bytes& to, const std::string& text) {
    to.insert(to.end(), text.begin(), text.end());
}

// A matrix profile whose three curves are the same.
Bytes profile(const double (&primaries)[3][3], const Bytes& curve) {
    std::vector<std::pair<std::string, Bytes>> tags;
    for (size_t c = 0; c < 3; ++c) {
        Bytes xyz;
        put(xyz, "XYZ ");
        put(xyz, 0);
        for (double v : primaries[c])
            put(xyz, uint32_t(int32_t(std::lround(v * 65536))));
        tags.emplace_back(std::string(1, "rgb"[c]) + "XYZ", xyz);
        tags.emplace_back(std::string(1, "rgb"[c]) + "TRC", curve);
    }
    Bytes out(16), data;
    put(out, "RGB ");
    out.resize(128);
    put(out, uint32_t(tags.size()));
    for (const auto& [name, bytes] : tags) {
        put(out, name);
        put(out, uint32_t(128 + 4 + 12 * tags.size() + data.size()));
        put(out, uint32_t(bytes.size()));
        data.insert(data.end(), bytes.begin(), bytes.end());
    }
    out.insert(out.end(), data.begin(), data.end());
    return out;
}

std::optional<std::string> told(const Bytes& bytes) {
    ImageSpec spec(1, 1, 3, OIIO::TypeUInt8);
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(bytes.size())),
                   bytes.data());
    spec.attribute("ICCProfile:profile_description", "mine");
    return unapplied_profile(spec);
}

const double kSrgb[3][3] = {
    {0.4360, 0.2225, 0.0139}, {0.3851, 0.7169, 0.0971}, {0.1431, 0.0606, 0.7141}};
const double kP3[3][3] = {
    {0.5151, 0.2412, -0.0011}, {0.2919, 0.6922, 0.0419}, {0.1572, 0.0666, 0.7841}};

Bytes parametric() {
    Bytes curve;
    put(curve, "para");
    put(curve, 0);
    put(curve, 3, 2);
    put(curve, 0, 2);
    for (double v : {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045})
        put(curve, uint32_t(std::lround(v * 65536)));
    return curve;
}

Bytes power(double gamma) {
    Bytes curve;
    put(curve, "curv");
    put(curve, 0);
    put(curve, 1);
    put(curve, uint32_t(std::lround(gamma * 256)), 2);
    return curve;
}

TEST(IccProfile, OnlyThatOfSrgbIsApplied) {
    EXPECT_EQ(unapplied_profile(ImageSpec(1, 1, 3, OIIO::TypeUInt8)), std::nullopt);
    EXPECT_EQ(told(profile(kSrgb, parametric())), std::nullopt);
    EXPECT_EQ(told(profile(kSrgb, power(2.2))), std::nullopt);
    EXPECT_EQ(told(profile(kSrgb, power(1.8))), "mine");
    EXPECT_EQ(told(profile(kP3, parametric())), "mine");
    const double swapped[3][3] = {{kSrgb[2][0], kSrgb[2][1], kSrgb[2][2]},
                                  {kSrgb[1][0], kSrgb[1][1], kSrgb[1][2]},
                                  {kSrgb[0][0], kSrgb[0][1], kSrgb[0][2]}};
    EXPECT_EQ(told(profile(swapped, parametric())), "mine");
}

TEST(IccProfile, DamagedOnesAreNotSrgb) {
    const Bytes whole = profile(kSrgb, parametric());
    for (size_t size = 0; size < whole.size(); size += 7)
        EXPECT_EQ(told(Bytes(whole.begin(), whole.begin() + ptrdiff_t(size))), "mine") << size;
}

} // namespace
} // namespace tonetool
