// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/lut_rows.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "target.h"

namespace tonetool::kernels {
namespace {

using Rgb = std::array<double, 3>;
using Planes3 = std::array<std::vector<float>, 3>;

CubeShape shape_of(int size, bool steep = true) {
    CubeShape shape;
    shape.size = size;
    shape.steep = steep;
    return shape;
}

LightCube make_cube(const CubeShape& shape, const std::function<Rgb(const Rgb&)>& light) {
    LightCube cube(shape);
    std::vector<float> row(3 * size_t(shape.size));
    for (int r = 0; r < shape.size; ++r)
        for (int g = 0; g < shape.size; ++g) {
            for (int b = 0; b < shape.size; ++b) {
                const Rgb rgb = light({cube.level(r), cube.level(g), cube.level(b)});
                for (size_t c = 0; c < 3; ++c)
                    row[3 * size_t(b) + c] = float(rgb[c]);
            }
            cube.set_row(r, g, row.data());
        }
    return cube;
}

// Film-like, with channels that mix and light that leaves [0,1] on both sides.
Rgb film(const Rgb& x) {
    const double sum = x[0] + x[1] + x[2];
    Rgb out;
    for (size_t c = 0; c < 3; ++c)
        out[c] = 1.3 * x[c] / (x[c] + 0.5) - 0.2 * x[(c + 1) % 3] / (sum + 0.3);
    return out;
}

Planes3 colors(size_t count, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> stops(-14, 14);
    Planes3 planes;
    for (auto& plane : planes)
        for (size_t i = 0; i < count; ++i)
            plane.push_back(float(std::exp2(stops(random))));
    // Greys, ties and ends.
    for (size_t i = 0; i + 8 < count; i += 8) {
        planes[1][i] = planes[0][i];
        planes[2][i] = planes[i % 16 ? 0 : 2][i];
        planes[2][i + 1] = planes[1][i + 1];
        planes[i % 3][i + 2] = 0;
        planes[i % 3][i + 3] = 3e38f;
    }
    return planes;
}

Planes3 map(const LightCube& cube, const Planes3& in, float scale = 1) {
    Planes3 out;
    for (auto& plane : out)
        plane.resize(in[0].size());
    const float* const from[3] = {in[0].data(), in[1].data(), in[2].data()};
    float* const to[3] = {out[0].data(), out[1].data(), out[2].data()};
    light_cube_rows(cube, from, to, ptrdiff_t(in[0].size()), scale);
    return out;
}

double largest_difference(const Planes3& a, const Planes3& b) {
    double most = 0;
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < a[c].size(); ++i)
            most = std::max(most, std::abs(double(a[c][i]) - double(b[c][i])));
    return most;
}

TEST(LutRows, EncodingIsItsOwnInverseAndContinuous) {
    for (double light = 0; light <= 1; light += 1.0 / 4096)
        EXPECT_NEAR(decode_light(encode_light(light)), light, 1e-15);
    EXPECT_EQ(decode_light(encode_light(-3)), 0);
    EXPECT_EQ(decode_light(encode_light(5)), 1);
    EXPECT_EQ(encode_light(NAN), encode_light(0));
    EXPECT_EQ(encode_light(1e30), encode_light(1e10));
    const double knee = 216.0 / 24389, tiny = 1e-9;
    for (double edge : {0.0, knee, -knee, 1.0})
        EXPECT_NEAR(encode_light(edge - tiny), encode_light(edge + tiny), 1e-7);
    for (double light = -2; light < 2; light += 1.0 / 512)
        EXPECT_LT(encode_light(light), encode_light(light + 1.0 / 512));
}

TEST(LutRows, LevelsAreWhereTheirPlacesAre) {
    for (bool steep : {false, true})
        for (int size : {2, 17, 81}) {
            const LightCube cube(shape_of(size, steep));
            EXPECT_EQ(cube.level(0), 0);
            EXPECT_NEAR(cube.level(size - 1), cube.shape().brightest, 1e-6);
            for (int i = 0; i < size; ++i)
                EXPECT_NEAR(cube.place(cube.level(i)), i, 1e-9);
            EXPECT_EQ(cube.place(1e30), size - 1);
        }
}

// Lanes against double: the place is a float of up to 80, good to 4e-6 of a cell, and f spans less
// than 0.2 in one here; beside it stand four roundings of f.
TEST(LutRows, LanesAgreeWithTheReferenceImplementation) {
    for (bool steep : {false, true}) {
        const LightCube cube = make_cube(shape_of(33, steep), film);
        const Planes3 in = colors(4099);
        on_every_target([&] {
            const Planes3 out = map(cube, in, 0.5f);
            for (size_t i = 0; i < in[0].size(); ++i) {
                double rgb[3], light[3];
                for (size_t c = 0; c < 3; ++c)
                    rgb[c] = double(std::min(in[c][i] * 0.5f, 1e15f));
                light_cube_reference(cube, rgb, light);
                for (size_t c = 0; c < 3; ++c)
                    ASSERT_NEAR(out[c][i], light[c], 3e-6) << i;
            }
        });
    }
}

TEST(LutRows, InstructionSetsAgree) {
    const LightCube cube = make_cube(shape_of(33), film);
    const Planes3 in = colors(4099);
    const Planes3 here = map(cube, in);
    on_every_target([&] { EXPECT_LT(largest_difference(map(cube, in), here), 1e-6); });
}

// f is linear in the places where the light is made so: between vertices as exact as on them.
TEST(LutRows, LinearFunctionsAreReproduced) {
    const CubeShape shape = shape_of(17);
    const LightCube places(shape);
    const double scale = 1.0 / (shape.size - 1);
    const auto code = [&](const Rgb& x, size_t c) {
        const double a = places.place(x[c]) * scale, b = places.place(x[(c + 1) % 3]) * scale;
        return 0.15 + 0.6 * a + 0.2 * b;
    };
    const LightCube cube = make_cube(shape, [&](const Rgb& x) {
        return Rgb{decode_light(code(x, 0)), decode_light(code(x, 1)), decode_light(code(x, 2))};
    });
    const Planes3 in = colors(1000);
    on_every_target([&] {
        const Planes3 out = map(cube, in);
        for (size_t i = 0; i < in[0].size(); ++i)
            for (size_t c = 0; c < 3; ++c)
                ASSERT_NEAR(
                    out[c][i],
                    decode_light(code({double(in[0][i]), double(in[1][i]), double(in[2][i])}, c)),
                    2e-6);
    });
}

TEST(LutRows, VerticesAreHit) {
    const LightCube cube = make_cube(shape_of(9), film);
    Planes3 in;
    for (int r = 0; r < 9; ++r)
        for (int g = 0; g < 9; ++g)
            for (int b = 0; b < 9; ++b) {
                in[0].push_back(float(cube.level(r)));
                in[1].push_back(float(cube.level(g)));
                in[2].push_back(float(cube.level(b)));
            }
    const Planes3 out = map(cube, in);
    for (size_t i = 0; i < in[0].size(); ++i) {
        const Rgb light = film({double(in[0][i]), double(in[1][i]), double(in[2][i])});
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(out[c][i], std::clamp(light[c], 0.0, 1.0), 2e-6);
    }
}

TEST(LutRows, GreysStayGrey) {
    const LightCube cube = make_cube(shape_of(17), [](const Rgb& x) {
        const double grey = (x[0] + x[1] + x[2]) / 3;
        return Rgb{film(x)[0] - film(x)[1] + grey, grey, grey};
    });
    Planes3 in = colors(500);
    in[1] = in[2] = in[0];
    const Planes3 out = map(cube, in);
    EXPECT_EQ(out[1], out[2]);
    EXPECT_LT(largest_difference({out[0], out[0], out[0]}, {out[1], out[1], out[1]}), 1e-6);
}

// Light that goes below 0 and above 1 is cut off where it does, not at the next vertex. A chord of
// f is within 3e-3 of the line here; with vertices cut off it were 3e-2, a quarter of a cell.
TEST(LutRows, LightIsCutOffWithinCells) {
    const auto light = [](double x) { return 0.5 * (x - 0.05); };
    const LightCube cube = make_cube(shape_of(65, false), [&](const Rgb& x) {
        return Rgb{light(x[0]), 0, 1};
    });
    Planes3 in;
    for (double x = 0; x < 4; x += 1.0 / 1024)
        for (auto& plane : in)
            plane.push_back(float(x));
    const Planes3 out = map(cube, in);
    for (size_t i = 0; i < in[0].size(); ++i) {
        EXPECT_NEAR(out[0][i], std::clamp(light(double(in[0][i])), 0.0, 1.0), 3e-3) << in[0][i];
        EXPECT_EQ(out[1][i], 0);
        EXPECT_EQ(out[2][i], 1);
    }
}

TEST(LutRows, RowsMayBeCutAnywhereAndLieAnywhere) {
    const LightCube cube = make_cube(shape_of(17), film);
    const Planes3 in = colors(103);
    on_every_target([&] {
        const Planes3 whole = map(cube, in, 2);
        for (size_t count = 0; count <= 40; ++count)
            for (size_t start : {0, 1, 7, 50}) {
                constexpr float kGuard = -7;
                Planes3 out;
                for (auto& plane : out)
                    plane.assign(count + 1, kGuard);
                const float* const from[3] = {&in[0][start], &in[1][start], &in[2][start]};
                float* const to[3] = {out[0].data(), out[1].data(), out[2].data()};
                light_cube_rows(cube, from, to, ptrdiff_t(count), 2);
                for (size_t c = 0; c < 3; ++c) {
                    for (size_t i = 0; i < count; ++i)
                        ASSERT_EQ(out[c][i], whole[c][start + i]);
                    ASSERT_EQ(out[c][count], kGuard);
                }
            }
        Planes3 here = in;
        float* const planes[3] = {here[0].data(), here[1].data(), here[2].data()};
        light_cube_rows(cube, planes, planes, ptrdiff_t(here[0].size()), 2);
        EXPECT_EQ(here, whole);
    });
}

TEST(LutRows, NoValueLeadsOutOfTheTable) {
    const LightCube cube = make_cube(shape_of(5), film);
    Planes3 in;
    for (float r : {0.0f, -1.0f, NAN, INFINITY, 3e38f, 1e-45f, -0.0f})
        for (float g : {0.0f, NAN, INFINITY})
            for (float b : {0.0f, 1.0f, INFINITY}) {
                in[0].push_back(r);
                in[1].push_back(g);
                in[2].push_back(b);
            }
    on_every_target([&] {
        for (float scale : {1e-30f, 1.0f, 1e38f})
            for (const auto& plane : map(cube, in, scale))
                for (float v : plane)
                    EXPECT_TRUE(v >= 0 && v <= 1) << v;
    });
}

} // namespace
} // namespace tonetool::kernels
