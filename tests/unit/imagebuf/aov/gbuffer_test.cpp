// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/gbuffer.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "files.h"
#include "refusal.h"

namespace tonetool {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// What a pixel of a test scene says of its surface.
struct Pixel {
    float p[3], n[3], a[3], z;
};

ImageSpec guide_spec(int width, int height, OIIO::TypeDesc format = OIIO::TypeFloat) {
    return make_spec(
        width, height,
        {"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "albedo.R", "albedo.G", "albedo.B", "Z"},
        format);
}

// A curved wall with a step of about .1 between pixels.
Pixel wall(int x, int y) {
    const double tilt = 0.05 * (x - y);
    return {{float(3 + 0.1003 * x), float(-2 + 0.0997 * y), float(1 + 0.01 * x * y)},
            {float(std::sin(tilt)), 0, float(std::cos(tilt))},
            {0.25f, float(0.01 * x), 0.75f},
            float(5 + 0.01 * x * y)};
}

using Change = std::function<void(Pixel&, int, int)>;

ImageBuf scene(const Change& change = {}, OIIO::TypeDesc format = OIIO::TypeFloat, int width = 16,
               int height = 12) {
    ImageBuf image(guide_spec(width, height, format));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Pixel pixel = wall(x, y);
            if (change)
                change(pixel, x, y);
            const float all[] = {pixel.p[0], pixel.p[1], pixel.p[2], pixel.n[0], pixel.n[1],
                                 pixel.n[2], pixel.a[0], pixel.a[1], pixel.a[2], pixel.z};
            image.setpixel(x, y, all);
        }
    return image;
}

GBuffer read(const ImageBuf& image, const GuideOptions& options = {}, ROI region = {},
             int nthreads = 1) {
    return read_gbuffer(image, find_gbuffer(image.spec(), options),
                        region.defined() ? region : image.roi(), nthreads);
}

GuideOptions without(bool position, bool normal, bool albedo, bool depth) {
    const auto word = [](bool out) { return std::string(out ? "none" : ""); };
    return {word(position), word(normal), word(albedo), word(depth), ""};
}

int background_count(const GBuffer& g) {
    return int(std::count(g.background.begin(), g.background.end(), 1));
}

TEST(GBuffer, ReadsWhatIsThere) {
    const GBuffer g = read(scene());
    EXPECT_THAT(g.warnings, IsEmpty());
    ASSERT_TRUE(g.has_position() && g.has_normal() && g.has_albedo() && g.has_depth());
    EXPECT_EQ(g.width, 16);
    EXPECT_EQ(g.height, 12);
    EXPECT_EQ(background_count(g), 0);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x) {
            const auto i = size_t(y * 16 + x);
            const Pixel pixel = wall(x, y);
            for (int c = 0; c < 3; ++c) {
                EXPECT_EQ(g.position[c][i], pixel.p[c]);
                EXPECT_NEAR(g.normal[c][i], pixel.n[c], 1e-7) << "a rounding of float";
                EXPECT_EQ(g.albedo[c][i], pixel.a[c]);
            }
            EXPECT_EQ(g.depth[i], pixel.z);
        }
    EXPECT_NEAR(g.footprint, 0.11, 0.02) << "the step of the wall";
    EXPECT_NEAR(g.half_ulp, std::ldexp(4.5045, -24), 1e-12) << "float, at the largest x";
}

TEST(GBuffer, ThreadsChangeNothing) {
    const auto image = scene([](Pixel& p, int x, int y) {
        if ((x + y) % 5 == 0)
            p.z = 1e10f;
    });
    const GBuffer one = read(image), many = read(image, {}, {}, 4);
    EXPECT_EQ(one.background, many.background);
    EXPECT_EQ(one.footprint, many.footprint);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(one.position[c], many.position[c]);
        EXPECT_EQ(one.normal[c], many.normal[c]);
    }
}

TEST(GBuffer, NothingFoundIsNoError) {
    const GBuffer g = read(constant(4, 3, {1, 1, 1}));
    EXPECT_FALSE(g.has_position() || g.has_normal() || g.has_albedo() || g.has_depth());
    EXPECT_THAT(g.background, Each(0));
    EXPECT_THAT(g.background, testing::SizeIs(12));
    EXPECT_THAT(g.warnings, IsEmpty());
    EXPECT_EQ(g.half_ulp, 0);
}

TEST(GBuffer, OnePixel) {
    const GBuffer g = read(scene({}, OIIO::TypeFloat, 1, 1));
    EXPECT_TRUE(g.has_position() && g.has_normal() && g.has_albedo() && g.has_depth());
    EXPECT_THAT(g.background, ElementsAre(0));
    EXPECT_THAT(g.warnings, IsEmpty());
    EXPECT_EQ(g.footprint, 0);
}

TEST(GBuffer, OutsideTheDataWindowIsBackground) {
    auto image = scene();
    image.specmod().x = -3;
    image.specmod().y = 20;
    const GBuffer g = read(image, {}, ROI(-5, 0, 19, 23));
    ASSERT_EQ(g.width, 5);
    ASSERT_EQ(g.height, 4);
    EXPECT_THAT(g.background,
                ElementsAre(1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0));
    EXPECT_EQ(g.position[0][7], wall(0, 0).p[0]);
    EXPECT_EQ(g.position[0][19], wall(2, 2).p[0]);
    EXPECT_EQ(g.position[0][6], 0);
    const GBuffer apart = read(image, {}, ROI(100, 102, 0, 2));
    EXPECT_THAT(apart.background, Each(1));
    EXPECT_THAT(apart.warnings, ElementsAre("no pixel shows a surface"));
}

struct Sky {
    const char* what;
    Change change; // of the pixel 3, 2
    GuideOptions options;
};

TEST(GBuffer, KnowsTheSky) {
    const GuideOptions all, no_depth = without(false, false, false, true),
                            bare = without(false, true, false, true),
                            depth_only = without(true, true, true, false);
    const std::vector<Sky> skies = {
        {"depth of Blender", [](Pixel& p, int, int) { p.z = 1e10f; }, all},
        {"infinite depth", [](Pixel& p, int, int) { p.z = kInf; }, all},
        {"infinite depth, nothing else", [](Pixel& p, int, int) { p.z = kInf; }, depth_only},
        {"depth 0, nothing else", [](Pixel& p, int, int) { p.z = 0; }, depth_only},
        {"no normal", [](Pixel& p, int, int) { p.n[0] = p.n[1] = p.n[2] = 0; }, all},
        {"at the origin", [](Pixel& p, int, int) { p.p[0] = p.p[1] = p.p[2] = 0; }, no_depth},
        {"at the origin, no normals", [](Pixel& p, int, int) { p.p[0] = p.p[1] = p.p[2] = 0; },
         bare},
        {"a silhouette: a normal, but far",
         [](Pixel& p, int, int) {
             p.z = 1e10f;
             p.n[0] = 0.3f;
         },
         all},
        {"a huge position", [](Pixel& p, int, int) { p.p[1] = -1e20f; }, no_depth},
    };
    for (const Sky& sky : skies) {
        const GBuffer g = read(scene([&](Pixel& p, int x, int y) {
                                   if (x == 3 && y == 2)
                                       sky.change(p, x, y);
                               }),
                               sky.options);
        EXPECT_EQ(background_count(g), 1) << sky.what;
        EXPECT_EQ(g.background[2 * 16 + 3], 1) << sky.what;
        EXPECT_THAT(g.warnings, IsEmpty()) << sky.what;
        if (g.has_position())
            EXPECT_EQ(g.position[1][2 * 16 + 3], 0) << sky.what;
    }
}

TEST(GBuffer, TheOriginIsAPlaceWhereDepthSaysSo) {
    const GBuffer g = read(scene([](Pixel& p, int x, int y) {
        if (x == 3 && y == 2)
            p.p[0] = p.p[1] = p.p[2] = 0;
    }));
    EXPECT_EQ(background_count(g), 0);
}

TEST(GBuffer, WhatIsNotFiniteIsBackground) {
    const GBuffer g = read(scene([](Pixel& p, int x, int y) {
        if (y == 1 && x == 0)
            p.p[0] = kNan;
        if (y == 1 && x == 1)
            p.n[2] = kInf;
        if (y == 1 && x == 2)
            p.a[1] = -kInf;
        if (y == 1 && x == 3)
            p.z = kNan;
    }));
    EXPECT_EQ(background_count(g), 4);
    EXPECT_EQ(g.nonfinite, 4);
    EXPECT_THAT(g.warnings, ElementsAre("4 pixel(s) are taken for background: a guide is not "
                                        "finite there"));
    for (int c = 0; c < 3; ++c)
        for (size_t i = 16; i < 20; ++i) {
            EXPECT_EQ(g.position[c][i], 0);
            EXPECT_EQ(g.normal[c][i], 0);
            EXPECT_EQ(g.albedo[c][i], 0);
            EXPECT_EQ(g.depth[i], 0);
        }
}

TEST(GBuffer, NormalsAreMadeUnitVectors) {
    const GBuffer g = read(scene([](Pixel& p, int x, int) {
        for (float& n : p.n)
            n *= x % 4 == 0 ? 0.3f : 0.97f;
    }));
    EXPECT_TRUE(g.has_normal());
    for (size_t i = 0; i < g.depth.size(); ++i)
        EXPECT_NEAR(std::hypot(g.normal[0][i], g.normal[1][i], g.normal[2][i]), 1, 1e-6);
    EXPECT_THAT(g.warnings, IsEmpty());
}

// Leaves: what a pixel sees points everywhere.
TEST(GBuffer, AveragedNormalsAreShort) {
    const GBuffer g = read(scene([](Pixel& p, int x, int y) {
        for (float& n : p.n)
            n *= (x + y) % 2 == 0 ? 0.4f : -0.7f;
    }));
    EXPECT_TRUE(g.has_normal());
    EXPECT_THAT(g.warnings, IsEmpty());
}

TEST(GBuffer, NormalsStoredAsColoursAreDecoded) {
    for (const auto& format : {OIIO::TypeFloat, OIIO::TypeHalf}) {
        const GBuffer g = read(scene(
            [](Pixel& p, int x, int y) {
                const bool none = x == 0 && y < 4;
                for (float& n : p.n)
                    n = none ? (y < 2 ? 0 : 128.0f / 255) : 0.5f + 0.5f * n;
            },
            format));
        ASSERT_TRUE(g.has_normal());
        EXPECT_THAT(g.warnings.at(0), HasSubstr("\"N\" is stored as 0..1"));
        EXPECT_EQ(background_count(g), 4) << "black, or the grey that is no direction";
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(g.normal[c][16 * 5 + 9], wall(9, 5).n[c], 1e-3) << "half has 11 bits";
    }
}

TEST(GBuffer, NormalsWithoutANegativePartAreNotDecoded) {
    const GBuffer g = read(scene([](Pixel& p, int, int) {
        p.n[0] = p.n[1] = 0;
        p.n[2] = 1;
    }));
    EXPECT_THAT(g.warnings, IsEmpty());
    EXPECT_EQ(g.normal[2][7], 1);
    EXPECT_EQ(g.normal[0][7], 0);
}

struct Wrong {
    const char* what;
    Change change; // of every pixel
    const char* warning;
};

TEST(GBuffer, AGuideThatHoldsSomethingElseIsNotUsed) {
    const std::vector<Wrong> cases = {
        {"P",
         [](Pixel& p, int x, int y) { p.p[0] = float(x % 2), p.p[1] = float(y % 2), p.p[2] = 1; },
         "position layer \"P\" is not used: all values lie within 0..1 and 100% of the pixels are "
         "clipped"},
        {"P", [](Pixel& p, int, int) { p.p[0] = p.p[1] = p.p[2] = 0.5; },
         "position layer \"P\" is not used: its longest side is 0 at values from 0.5 to 0.5: 0 "
         "steps"},
        {"P", [](Pixel& p, int, int) { p.p[0] = p.p[1] = p.p[2] = 0; },
         "position layer \"P\" is not used: it is zero, huge or not finite everywhere"},
        {"P", [](Pixel& p, int, int) { p.p[1] = kNan; },
         "position layer \"P\" is not used: it is zero, huge or not finite everywhere"},
        {"N", [](Pixel& p, int x, int) { p.n[0] = float(x), p.n[1] = -3; },
         "normal layer \"N\" is not used: 0% of its vectors have a length near 1, with components "
         "from -3 to 15"},
        {"N", [](Pixel& p, int, int) { p.n[0] = p.n[1] = p.n[2] = 0; },
         "normal layer \"N\" is not used: it is zero or not finite everywhere"},
        {"albedo", [](Pixel& p, int x, int) { p.a[1] = float(x); },
         "albedo layer \"albedo\" is not used: 88% of its pixels are outside 0..1.5, from 0 to "
         "15: light, not reflectance"},
        {"albedo", [](Pixel& p, int, int) { p.a[1] = kNan; },
         "albedo layer \"albedo\" is not used: it holds no number"},
        {"Z", [](Pixel& p, int, int) { p.z = 0; },
         "depth layer \"Z\" is not used: it is zero everywhere"},
        {"Z", [](Pixel& p, int, int) { p.z = kNan; },
         "depth layer \"Z\" is not used: it holds no number"},
        {"Z", [](Pixel& p, int x, int) { p.z = float(15 - x) / 15; },
         "depth layer \"Z\" is not used: its values run from 0 to exactly 1: normalised for "
         "display"},
        {"Z", [](Pixel& p, int x, int) { p.z = float(x - 8); },
         "depth layer \"Z\" is not used: its values run from -8 to 7"},
    };
    for (const Wrong& wrong : cases) {
        const GBuffer g = read(scene(wrong.change));
        EXPECT_THAT(g.warnings, ElementsAre(HasSubstr(wrong.warning))) << wrong.warning;
        const std::string what = wrong.what;
        EXPECT_EQ(g.has_position(), what != "P") << wrong.warning;
        EXPECT_EQ(g.has_normal(), what != "N") << wrong.warning;
        EXPECT_EQ(g.has_albedo(), what != "albedo") << wrong.warning;
        EXPECT_EQ(g.has_depth(), what != "Z") << wrong.warning;
        EXPECT_EQ(background_count(g), 0) << wrong.warning;
    }
}

// A room of side 1: every wall has a component at an end of 0..1.
TEST(GBuffer, ARoomOfSideOneIsNotClipped) {
    const GBuffer g = read(scene([](Pixel& p, int x, int y) {
        p.p[0] = float(x) / 15;
        p.p[1] = float(y) / 11;
        p.p[2] = 1;
    }));
    EXPECT_TRUE(g.has_position());
    EXPECT_THAT(g.warnings, IsEmpty());
}

TEST(GBuffer, NegativeDepthIsTurned) {
    const GBuffer g = read(scene([](Pixel& p, int x, int) { p.z = x == 0 ? -1e10f : -p.z; }));
    ASSERT_TRUE(g.has_depth());
    EXPECT_EQ(g.depth[5], wall(5, 0).z);
    EXPECT_EQ(background_count(g), 12);
    EXPECT_THAT(g.warnings, ElementsAre("depth layer \"Z\" is negative: its sign is turned"));
}

TEST(GBuffer, AlbedoIsClamped) {
    const GBuffer g = read(scene([](Pixel& p, int x, int y) {
        if (x == 2 && y == 0)
            p.a[0] = 50;
        if (x == 3 && y == 0)
            p.a[0] = -0.5f;
    }));
    EXPECT_EQ(g.albedo[0][2], 1);
    EXPECT_EQ(g.albedo[0][3], 0);
    EXPECT_THAT(g.warnings, IsEmpty());
}

// Far from the origin halves are coarser than the steps between pixels.
TEST(GBuffer, HalfPositionsAreMeasured) {
    const GBuffer near = read(scene({}, OIIO::TypeHalf));
    EXPECT_NEAR(near.half_ulp, 4.5045 / 2048, 1e-5);
    EXPECT_THAT(near.warnings, IsEmpty());
    const auto far = [](Pixel& p, int, int) { p.p[0] += 300; };
    const auto image = scene(far, OIIO::TypeHalf);
    const GBuffer half = read(image);
    EXPECT_NEAR(half.half_ulp, 304.5 / 2048, 1e-3);
    EXPECT_THAT(half.warnings, ElementsAre(HasSubstr("position layer \"P\" is as coarse as half")));
    // The same once somebody has made floats of them.
    ImageBuf floats(guide_spec(16, 12));
    floats.set_pixels(floats.roi(), OIIO::TypeFloat, values(image).data());
    EXPECT_EQ(read(floats).half_ulp, half.half_ulp);
    EXPECT_EQ(read(floats).warnings, half.warnings);
    EXPECT_THAT(read(scene(far)).warnings, IsEmpty()) << "floats";
}

TEST(GBuffer, IntegersHoldNoDistances) {
    const GBuffer g = read(scene({}, OIIO::TypeUInt8));
    EXPECT_FALSE(g.has_position() || g.has_depth());
    EXPECT_TRUE(g.has_albedo());
    EXPECT_THAT(g.warnings,
                testing::Contains("position layer \"P\" is not used: it is stored as uint8"));
    EXPECT_THAT(g.warnings,
                testing::Contains("depth layer \"Z\" is not used: it is stored as uint8"));
}

TEST(GBuffer, FromFilesAsFromMemory) {
    const Folder folder;
    const auto image = scene([](Pixel& p, int x, int) { p.z = x < 3 ? 1e10f : p.z; });
    const GBuffer expected = read(image);
    for (int tile : {0, 16}) {
        const UnreadFile file(write_file(folder / "g.exr", image, {OIIO::TypeFloat, "zip", tile}));
        const GBuffer g = read(file.image);
        EXPECT_EQ(g.background, expected.background);
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(g.position[c], expected.position[c]);
            EXPECT_EQ(g.normal[c], expected.normal[c]);
            EXPECT_EQ(g.albedo[c], expected.albedo[c]);
        }
        EXPECT_EQ(g.depth, expected.depth);
        EXPECT_EQ(file.cached_bytes(), 0);
    }
}

TEST(GBuffer, WhatCannotBeReadIsAnError) {
    EXPECT_EQ(refusal([] { read_gbuffer(ImageBuf(), {}, ROI(0, 1, 0, 1), 1); }),
              "guide image: is not initialized");
    EXPECT_EQ(refusal([] { read_gbuffer(scene(), {}, ROI(0, 0, 0, 1), 1); }),
              "the region holds no pixel");
}

TEST(GBuffer, OfRenderedScenes) {
    for (const std::string name : {"cornell", "nightstreet", "gallery"}) {
        const UnreadFile file(TESTIMAGES_DIR "/" + name + "_ref.exr");
        const GBuffer g = read(file.image);
        EXPECT_TRUE(g.has_position() && g.has_normal() && g.has_albedo() && g.has_depth()) << name;
        EXPECT_THAT(g.warnings, IsEmpty()) << name;
        EXPECT_EQ(g.nonfinite, 0);
        const ImageBuf whole = read_whole(std::string(file.image.name()));
        const int z = whole.spec().channelindex("ViewLayer.Depth.Z");
        size_t i = 0;
        int far = 0;
        for (ImageBuf::ConstIterator<float> p(whole); !p.done(); ++p, ++i) {
            EXPECT_EQ(g.background[i] != 0, p[z] == 1e10f) << name << " " << p.x() << " " << p.y();
            far += p[z] == 1e10f;
        }
        EXPECT_EQ(far > 0, name == "nightstreet");
        EXPECT_GT(g.footprint, 0.005) << "metres";
        EXPECT_LT(g.footprint, 0.5) << "metres";
        // Without the depth the sky is at the origin.
        EXPECT_EQ(read(file.image, without(false, false, false, true)).background, g.background);
    }
}

} // namespace
} // namespace tonetool
