// SPDX-License-Identifier: BSD-3-Clause
// Drago's curve against pictures by HDR Toolbox (see the MANIFEST beside the goldens), which
// divides the adapted luminance by (1 + bias - 0.85)^5.
#include <gtest/gtest.h>

#include <OpenImageIO/imagebuf.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "kernels/curve_rows.h"
#include "tonemap/curves.h"
#include "tonetool/pixels.h"

namespace {

using nlohmann::json;
using OIIO::ImageBuf;
using tonetool::kernels::CurveUse;

constexpr double kClose = 1e-5; // relative: theirs is double rounded to float, ours is float

struct Golden {
    std::string name, scene, map;
    double bias, adapted, largest; ///< luminance
};

using Planes = std::vector<float>[3];

void read_planes(const ImageBuf& image, const int (&channels)[3], Planes& planes) {
    for (size_t c = 0; c < 3; ++c) {
        OIIO::ROI roi = image.roi();
        roi.chbegin = channels[c];
        roi.chend = channels[c] + 1;
        planes[c].resize(size_t(roi.width()) * size_t(roi.height()));
        ASSERT_TRUE(image.get_pixels(roi, OIIO::TypeFloat, planes[c].data()));
    }
}

class DragoGoldens : public testing::TestWithParam<Golden> {};

TEST_P(DragoGoldens, MatchesHdrToolbox) {
    const Golden& golden = GetParam();
    const ImageBuf scene(golden.scene), map(golden.map);
    tonetool::ColorChoice choice;
    std::string error;
    ASSERT_TRUE(tonetool::ToneAlgo::find_color(scene.spec(), {}, choice, error)) << error;
    Planes ours, theirs;
    ASSERT_NO_FATAL_FAILURE(read_planes(scene, {choice.r, choice.g, choice.b}, ours));
    ASSERT_NO_FATAL_FAILURE(read_planes(map, {0, 1, 2}, theirs));
    ASSERT_EQ(ours[0].size(), theirs[0].size());

    const double adapted = golden.adapted / std::pow(1 + golden.bias - 0.85, 5);
    const auto& row = *tonetool::tonemap::find_curve("drago");
    const auto values = tonetool::tonemap::curve_values(
        row, {{"white", golden.largest / adapted}, {"bias", golden.bias}}, false);
    CurveUse use;
    use.on_luminance = true;
    use.clamp = false;
    float* const at[3] = {ours[0].data(), ours[1].data(), ours[2].data()};
    tonetool::kernels::curve_rows(row.make(values), use, at, at, ptrdiff_t(ours[0].size()),
                                  float(1 / adapted));
    double worst = 0;
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < ours[c].size(); ++i) {
            const double y = theirs[c][i], off = std::abs(double(ours[c][i]) - y);
            worst = std::max(worst, y == 0 ? off : off / std::abs(y));
        }
    EXPECT_LE(worst, kClose);
    std::printf("  worst %.3g\n", worst);
}

std::vector<Golden> small() {
    const std::string root = TESTIMAGES_DIR "/";
    std::vector<Golden> out;
    std::ifstream in(root + "golden/drago.jsonl");
    for (std::string text; std::getline(in, text);) {
        const json line = json::parse(text);
        out.push_back({line["name"], root + line["scene"].get<std::string>(),
                       root + line["map"].get<std::string>(), line["bias"], line["Lwa_geometric"],
                       line["Lmax"]});
    }
    return out;
}

std::string shared_dir() {
    const char* dir = std::getenv("SHARED_DIR");
    return dir ? std::string(dir) + "/" : "";
}

std::vector<Golden> shared() {
    std::vector<Golden> out;
    for (const std::string scene : {"cornell", "nightstreet", "gallery"}) {
        std::ifstream in(shared_dir() + "golden/drago/" + scene + ".json");
        if (!in)
            continue;
        const json numbers = json::parse(in);
        for (int bias : {70, 85, 90}) {
            const std::string name = scene + "_b" + std::to_string(bias);
            out.push_back({name, shared_dir() + "scenes/" + scene + "/ref.exr",
                           shared_dir() + "golden/drago/" + name + ".exr", bias / 100.0,
                           numbers["Lwa_geometric"], numbers["Lmax"]});
        }
    }
    return out;
}

const auto name_of = [](const auto& test) { return test.param.name; };

INSTANTIATE_TEST_SUITE_P(Small, DragoGoldens, testing::ValuesIn(small()), name_of);
INSTANTIATE_TEST_SUITE_P(Shared, DragoGoldens, testing::ValuesIn(shared()), name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(DragoGoldens);

TEST(DragoGoldenFiles, SmallOnesAreThere) {
    EXPECT_EQ(small().size(), 3u);
}

TEST(DragoGoldenFiles, SharedOnesAreThere) {
    if (shared().empty())
        GTEST_SKIP() << "no golden/drago below SHARED_DIR (\"" << shared_dir()
                     << "\"): the large goldens are not compared";
}

} // namespace
