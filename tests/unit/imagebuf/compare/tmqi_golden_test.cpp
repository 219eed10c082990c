// SPDX-License-Identifier: BSD-3-Clause
// TMQI against the numbers of the authors' program (see the MANIFEST beside the goldens).
#include <gtest/gtest.h>

#include <OpenImageIO/imagebuf.h>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "tonetool/tmqi.h"

namespace {

using nlohmann::json;
using OIIO::ImageBuf;

// Theirs are printed with nine digits. What is left is the noise of their variances, which they
// compute from squares of 32-bit numbers; it was 1.4e-6 at most in single scales.
constexpr double kClose = 5e-6;

struct Golden {
    std::string name, scene, picture;
    json numbers;
};

class TmqiGoldens : public testing::TestWithParam<Golden> {};

TEST_P(TmqiGoldens, MatchHdrToolbox) {
    const Golden& golden = GetParam();
    const ImageBuf hdr(golden.scene), ldr(golden.picture);
    tonetool::TmqiSummary found;
    const ImageBuf map = tonetool::ToneAlgo::tmqi(hdr, ldr, {}, &found);
    ASSERT_FALSE(map.has_error()) << map.geterror();
    const auto& s = found.score;
    EXPECT_NEAR(s.q, golden.numbers["Q"].get<double>(), kClose);
    EXPECT_NEAR(s.s, golden.numbers["S"].get<double>(), kClose);
    EXPECT_NEAR(s.n, golden.numbers["N"].get<double>(), kClose);
    for (size_t i = 0; i < s.scales.size(); ++i)
        EXPECT_NEAR(s.scales[i], golden.numbers["s_local"][i].get<double>(), kClose) << i;
    std::printf("  Q %+.2g S %+.2g N %+.2g\n", s.q - golden.numbers["Q"].get<double>(),
                s.s - golden.numbers["S"].get<double>(), s.n - golden.numbers["N"].get<double>());
}

std::vector<Golden> goldens(const std::string& list, const std::string& prefix,
                            const std::function<std::string(const std::string&)>& scene_file,
                            const std::string& scene_of_all) {
    std::vector<Golden> out;
    std::ifstream in(list);
    for (std::string text; std::getline(in, text);) {
        const json line = json::parse(text);
        const std::string scene = line.value("scene", scene_of_all);
        const std::string name = scene + "_" + line["ldr"].get<std::string>();
        out.push_back({name, scene_file(scene), prefix + name + ".png", line});
    }
    return out;
}

std::vector<Golden> small() {
    const std::string root = TESTIMAGES_DIR "/";
    return goldens(
        root + "golden/tmqi.jsonl", root + "golden/",
        [=](const std::string& scene) { return root + scene + "_ref.exr"; }, "");
}

std::string shared_dir() {
    const char* dir = std::getenv("SHARED_DIR");
    return dir ? std::string(dir) + "/" : "";
}

std::vector<Golden> shared() {
    std::vector<Golden> out;
    for (const std::string name : {"cornell", "nightstreet", "gallery"}) {
        const auto of_scene = goldens(
            shared_dir() + "golden/tmqi/" + name + ".jsonl", shared_dir() + "golden/tmqi/",
            [](const std::string& scene) { return shared_dir() + "scenes/" + scene + "/ref.exr"; },
            name);
        out.insert(out.end(), of_scene.begin(), of_scene.end());
    }
    return out;
}

const auto name_of = [](const auto& test) { return test.param.name; };

INSTANTIATE_TEST_SUITE_P(Small, TmqiGoldens, testing::ValuesIn(small()), name_of);
INSTANTIATE_TEST_SUITE_P(Shared, TmqiGoldens, testing::ValuesIn(shared()), name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(TmqiGoldens);

TEST(TmqiGoldenFiles, SmallOnesAreThere) {
    EXPECT_EQ(small().size(), 6u);
}

TEST(TmqiGoldenFiles, SharedOnesAreThere) {
    if (shared().empty())
        GTEST_SKIP() << "no golden/tmqi below SHARED_DIR (\"" << shared_dir()
                     << "\"): the large goldens are not compared";
}

} // namespace
