// SPDX-License-Identifier: BSD-3-Clause
// The baked table of a view against the view.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <thread>

#include "flip/evaluate.h"
#include "flip/filters.h"
#include "imagebuf/color/bake_error.h"
#include "imagebuf/color/color_reader.h"
#include "imagebuf/color/view.h"
#include "imagebuf/pixels/parallel.h"
#include "images.h"
#include "view_configs.h"

namespace tonetool {
namespace {

using Planes3 = std::array<std::vector<float>, 3>;

Planes3 map(const kernels::ToneRows& rows, const Planes3& in, float scale = 1) {
    Planes3 out;
    for (auto& plane : out)
        plane.resize(in[0].size());
    const float* const from[3] = {in[0].data(), in[1].data(), in[2].data()};
    float* const to[3] = {out[0].data(), out[1].data(), out[2].data()};
    rows(from, to, ptrdiff_t(in[0].size()), scale);
    return out;
}

// Random colours of a few stops around a path of brightness, as pictures have them.
Planes3 colors(size_t count) {
    std::mt19937 random(3);
    std::normal_distribution<double> stops(0, 1);
    Planes3 out;
    for (size_t i = 0; i < count; ++i) {
        const double middle = 16 * double(i) / double(count) - 10;
        for (auto& plane : out)
            plane.push_back(float(std::exp2(middle + stops(random))));
    }
    return out;
}

double lightness(const Planes3& rgb, size_t i) {
    double y = 0;
    for (size_t c = 0; c < 3; ++c)
        y += kernels::kLuminance[c] * double(rgb[c][i]);
    return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389.0 / 27;
}

class ViewBakeTest : public testing::Test {
protected:
    DisplayLight open(const std::string& display, const std::string& view,
                      std::optional<double> peak = {}) {
        ViewOptions options;
        options.config = write_text(folder / "config.ocio", kConfig);
        options.display = display;
        options.view = view;
        DisplayLight light;
        light.open({options, "", peak});
        return light;
    }

    Folder folder;
};

// What is measured, and a quarter on top: L* of one in the next is seen under the best conditions.
TEST_F(ViewBakeTest, TableIsCloseToTheView) {
    struct Case {
        const char *display, *view;
        std::optional<double> peak;
        double most, mean;
    };
    const Planes3 in = colors(20000);
    for (const Case& c :
         {Case{"sRGB", "SDR", {}, 0.2, 0.015}, Case{"Rec.1886", "SDR", {}, 0.2, 0.015},
          Case{"sRGB", "Plain", {}, 0.05, 0.015}, Case{"PQ", "HDR 1000", 1000.0, 0.2, 0.015}}) {
        const DisplayLight light = open(c.display, c.view, c.peak);
        const Planes3 exact = map(light.exact(), in), baked = map(light.baked(), in);
        double most = 0, sum = 0;
        for (size_t i = 0; i < in[0].size(); ++i) {
            const double apart = std::abs(lightness(exact, i) - lightness(baked, i));
            most = std::max(most, apart);
            sum += apart;
        }
        EXPECT_LT(most, c.most) << light.name();
        EXPECT_LT(sum / double(in[0].size()), c.mean) << light.name();
    }
}

TEST_F(ViewBakeTest, BlackAndBurntOutStayWhatTheyAre) {
    const DisplayLight light = open("sRGB", "SDR");
    Planes3 in;
    for (auto& plane : in)
        plane = {0, 0, 1e-7f, 1e4f, 1e15f, 3e38f};
    const Planes3 exact = map(light.exact(), in), baked = map(light.baked(), in);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < in[c].size(); ++i)
            EXPECT_NEAR(exact[c][i], baked[c][i], 1e-4) << i;
}

TEST_F(ViewBakeTest, ScaleIsAnExposure) {
    const DisplayLight light = open("sRGB", "SDR");
    const Planes3 in = colors(1000);
    Planes3 doubled = in;
    for (auto& plane : doubled)
        for (float& v : plane)
            v *= 2;
    EXPECT_EQ(map(light.exact(), in, 2), map(light.exact(), doubled));
    EXPECT_EQ(map(light.baked(), in, 2), map(light.baked(), doubled));
}

TEST_F(ViewBakeTest, ExactRowsMayBeCutAnywhere) {
    const DisplayLight light = open("sRGB", "SDR");
    const Planes3 in = colors(1300);
    const Planes3 whole = map(light.exact(), in);
    for (size_t from = 0; from < in[0].size(); from += 37) {
        const size_t to = std::min(from + 37, in[0].size());
        Planes3 part;
        for (size_t c = 0; c < 3; ++c)
            part[c].assign(in[c].begin() + ptrdiff_t(from), in[c].begin() + ptrdiff_t(to));
        const Planes3 out = map(light.exact(), part);
        for (size_t c = 0; c < 3; ++c)
            for (size_t i = from; i < to; ++i)
                ASSERT_EQ(out[c][i - from], whole[c][i]);
    }
}

TEST_F(ViewBakeTest, ThreadsShareOneTable) {
    const DisplayLight light = open("sRGB", "SDR");
    const Planes3 in = colors(500);
    Planes3 out[4];
    std::vector<std::thread> threads;
    for (Planes3& result : out)
        threads.emplace_back([&] { result = map(light.baked(), in); });
    for (std::thread& thread : threads)
        thread.join();
    for (const Planes3& result : out)
        EXPECT_EQ(result, out[0]);
    // Rows outlive what they came from.
    kernels::ToneRows rows;
    {
        const DisplayLight other = open("sRGB", "SDR");
        rows = other.baked();
    }
    EXPECT_EQ(map(rows, in), out[0]);
}

TEST_F(ViewBakeTest, ErrorIsMeasuredOnABoundedSample) {
    const DisplayLight light = open("sRGB", "SDR");
    const ImageBuf image = noise(400, 300, 7);
    const ColorPlanes planes = read_planes(image, {}, image.roi(), false, 1);
    const std::vector<double> stops = {-4, 0, 4};
    const BakeError error = measure_bake(light, planes, 0, 300, stops);
    EXPECT_GT(error.max, 0);
    EXPECT_LT(error.max, 0.03);
    EXPECT_GT(error.mean(), 0);
    EXPECT_LT(error.mean(), 2e-4);
    EXPECT_LE(error.samples, 3 * 65536);
    EXPECT_GT(error.samples, 3 * 30000);
    // Bands of any height add up to it.
    BakeError bands;
    for (int y = 0; y < 300; y += 37)
        bands.add(measure_bake(light, planes, y, std::min(y + 37, 300), stops));
    EXPECT_EQ(bands.max, error.max);
    EXPECT_EQ(bands.samples, error.samples);
    EXPECT_NEAR(bands.sum, error.sum, 1e-9 * error.sum); // another order
    const BakeError many = measure_bake(light, planes, 0, 300, std::vector<double>(1000));
    EXPECT_LE(many.samples, 3 * 65536);
}

std::vector<float> ldr_flip(const Planes3& a, const Planes3& b, int width, int height) {
    flip::Evaluation what;
    what.taps = flip::lane_taps(flip::make_taps(67));
    what.stops = {0};
    std::vector<float> error(a[0].size());
    flip::Output output;
    output.error = error.data();
    output.stride = width;
    const auto view = [&](const Planes3& p) {
        return kernels::ConstRgb{{p[0].data(), p[1].data(), p[2].data()}, width, width, height};
    };
    flip::evaluate(what, view(a), {view(b)}, {0, 0, width, height}, {output}, make_parallel(1));
    return error;
}

Planes3 read_planes(const std::string& name, int& width, int& height) {
    const ImageBuf image = read_whole(name);
    width = image.spec().width;
    height = image.spec().height;
    Planes3 out;
    for (int c = 0; c < 3; ++c) {
        out[size_t(c)].resize(size_t(width) * size_t(height));
        OIIO::ROI roi = image.roi();
        roi.chbegin = c;
        roi.chend = c + 1;
        EXPECT_TRUE(image.get_pixels(roi, OIIO::TypeFloat, out[size_t(c)].data()));
        for (float& v : out[size_t(c)])
            v = std::max(v, 0.0f);
    }
    return out;
}

// HDR-FLIP, the maximum over the exposures, of scenes rendered with few samples.
TEST_F(ViewBakeTest, HdrFlipUnderTheTableIsThatUnderTheView) {
    const char* shared = std::getenv("SHARED_DIR");
    const std::string scenes = std::string(shared ? shared : "") + "/scenes/small/";
    if (!OIIO::Filesystem::exists(scenes))
        GTEST_SKIP() << "no " << scenes;
    const DisplayLight light = open("sRGB", "SDR");
    for (const std::string scene : {"nightstreet", "gallery", "cornell"}) {
        int width = 0, height = 0;
        const Planes3 reference = read_planes(scenes + scene + "_ref.exr", width, height);
        const Planes3 test = read_planes(scenes + scene + "_test.exr", width, height);
        std::vector<float> exact(reference[0].size()), baked = exact;
        for (int stop = -8; stop <= 6; ++stop) {
            const auto scale = float(std::exp2(stop));
            const auto add = [&](const kernels::ToneRows& rows, std::vector<float>& most) {
                const auto error =
                    ldr_flip(map(rows, reference, scale), map(rows, test, scale), width, height);
                for (size_t i = 0; i < error.size(); ++i)
                    most[i] = std::max(most[i], error[i]);
            };
            add(light.exact(), exact);
            add(light.baked(), baked);
        }
        double most = 0, sum = 0;
        for (size_t i = 0; i < exact.size(); ++i) {
            const double apart = std::abs(double(exact[i]) - double(baked[i]));
            most = std::max(most, apart);
            sum += apart;
        }
        EXPECT_LT(most, 5e-3) << scene;
        EXPECT_LT(sum / double(exact.size()), 5e-4) << scene;
    }
}

} // namespace
} // namespace tonetool
