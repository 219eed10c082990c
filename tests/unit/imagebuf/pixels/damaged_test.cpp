// SPDX-License-Identifier: BSD-3-Clause
// Every public function that takes images, over files that cannot be read whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <regex>
#include <set>

#include "damaged_files.h"
#include "imagebuf/pixels/utf8.h"
#include "tonetool/texture.h"
#include "tonetool/tonetool.h"

namespace tonetool {
namespace {

using testing::HasSubstr;

// Integers as linear values, lest a function refuses what is display-encoded before it reads.
const PixelOptions kLinear{"", "rec709"};

template <class Options>
Options linear(Options options = {}) {
    options.pixels = kLinear;
    return options;
}

// What a function is given, and where its result would be.
struct Call {
    const ImageBuf& bad;
    const ImageBuf& good;
    ImageBuf& dst;
    std::string& error;
    std::string file; ///< to write to
};

struct Function {
    const char* name; ///< in the header
    const char* how;
    std::function<bool(const Call&)> run;
    bool layers = false; ///< wants light groups
};

CalibrationOptions calibrated(CalibrationMethod method) {
    CalibrationOptions options;
    options.method = method;
    return options;
}

TonemapOptions mapped(const std::string& curve, CalibrationMethod method, bool white) {
    TonemapOptions options = linear<TonemapOptions>();
    options.curve.name = curve;
    options.calibration.method = method;
    if (white)
        options.calibration.white_percentile = 99.0;
    return options;
}

std::vector<Function> comparisons() {
    using namespace ToneAlgo;
    std::vector<Function> all;
    for (bool first : {true, false}) {
        const char* how = first ? "first" : "second";
        const auto a = [first](const Call& c) -> const ImageBuf& { return first ? c.bad : c.good; };
        const auto b = [first](const Call& c) -> const ImageBuf& { return first ? c.good : c.bad; };
        all.push_back({"ldr_flip", how, [=](const Call& c) {
                           return ldr_flip(c.dst, a(c), b(c), linear<FlipOptions>());
                       }});
        all.push_back({"hdr_flip", how, [=](const Call& c) {
                           return hdr_flip(c.dst, a(c), b(c), linear<HdrFlipOptions>());
                       }});
        all.push_back(
            {"hdr_flip", how, [=](const Call& c) {
                 std::vector<ImageBuf> maps;
                 const bool done = hdr_flip(maps, a(c), {&c.good, &b(c)}, linear<HdrFlipOptions>());
                 c.dst = maps.at(0);
                 c.error = maps.at(0).geterror();
                 return done;
             }});
        all.push_back({"flip_exposed", how, [=](const Call& c) {
                           std::vector<FlipExposure> shown;
                           return flip_exposed(shown, a(c), b(c), c.error,
                                               linear<HdrFlipOptions>());
                       }});
        all.push_back({"flip_filmstrip", how, [=](const Call& c) {
                           return flip_filmstrip(c.dst, a(c), b(c), linear<HdrFlipOptions>());
                       }});
        for (bool second_seed : {false, true})
            all.push_back({"bias_check", how, [=](const Call& c) {
                               std::vector<const ImageBuf*> references{&a(c)}, tests{&b(c)};
                               if (second_seed) // behind one that can be read
                                   (first ? references : tests) = {&c.good, &c.bad};
                               return bias_check(c.dst, references, tests, linear<BiasOptions>());
                           }});
        all.push_back({"tmqi", how, [=](const Call& c) {
                           TmqiOptions options;
                           options.hdr = options.ldr = kLinear;
                           return tmqi(c.dst, a(c), b(c), options);
                       }});
        for (const char* metric : {"smape", "mpsnr"})
            all.push_back({"error_map", how, [=](const Call& c) {
                               ErrorOptions options = linear<ErrorOptions>();
                               options.metric = metric;
                               return error_map(c.dst, a(c), b(c), options);
                           }});
    }
    return all;
}

std::vector<Function> pictures() {
    using namespace ToneAlgo;
    using Method = CalibrationMethod;
    std::vector<Function> all;
    for (const auto& [method, white] :
         {std::pair(Method::Manual, false), {Method::Mean, false}, {Method::AutoKey, true}})
        all.push_back(
            {"tonemap", white ? "white" : "aces", [method = method, white = white](const Call& c) {
                 return tonemap(c.dst, c.bad,
                                mapped(white ? "logarithmic" : "aces", method, white));
             }});
    for (Method method : {Method::Manual, Method::Mean})
        all.push_back(
            {"calibrate", method == Method::Mean ? "mean" : "manual", [method](const Call& c) {
                 return calibrate(c.dst, c.bad, calibrated(method), kLinear);
             }});
    for (const ROI& roi : {ROI(), ROI(3, 9, 2, 32)}) {
        const char* how = roi.defined() ? "part" : "whole";
        all.push_back({"tonemap", how, [roi](const Call& c) {
                           return tonemap(c.dst, c.bad, linear<TonemapOptions>(), nullptr, roi);
                       }});
        all.push_back({"bloom", how, [roi](const Call& c) {
                           return bloom(c.dst, c.bad, linear<BloomOptions>(), nullptr, roi);
                       }});
        all.push_back({"exposure", how,
                       [roi](const Call& c) { return exposure(c.dst, c.bad, 1, kLinear, roi); }});
        all.push_back(
            {"encode_srgb", how, [roi](const Call& c) { return encode_srgb(c.dst, c.bad, roi); }});
        all.push_back({"color_map", how, [roi](const Call& c) {
                           return color_map(c.dst, c.bad, std::string("magma"), -1, roi);
                       }});
    }
    all.push_back({"color_map", "triples", [](const Call& c) {
                       return color_map(c.dst, c.bad, std::vector<float>{0, 0, 0, 1, 1, 1}, 0);
                   }});
    all.push_back({"cg_tmo", "plain",
                   [](const Call& c) { return cg_tmo(c.dst, c.bad, linear<CgTmoOptions>()); }});
    all.push_back({"light_index", "groups",
                   [](const Call& c) { return light_index(c.dst, c.bad, {}, kLinear); }, true});
    return all;
}

std::vector<Function> numbers_and_files() {
    using namespace ToneAlgo;
    return {
        {"luminance_stats", "",
         [](const Call& c) {
             LuminanceStats stats;
             return luminance_stats(stats, c.bad, c.error, kLinear);
         }},
        {"frame_light", "",
         [](const Call& c) {
             FrameLight light;
             return frame_light(light, c.bad, c.error, kLinear);
         }},
        {"steady_frame", "",
         [](const Call& c) {
             SteadyFrame frame;
             return steady_frame(frame, c.bad, c.error, linear<CgTmoOptions>());
         }},
        {"frame_camera", "",
         [](const Call& c) {
             std::vector<double> camera;
             return frame_camera(camera, c.bad, c.error, linear<CgTmoOptions>());
         }},
        {"panorama_stats", "",
         [](const Call& c) {
             PanoramaStats stats;
             return panorama_stats(stats, c.bad, c.error, linear<PanoramaOptions>());
         }},
        {"against_facts", "approved",
         [](const Call& c) {
             AgainstFacts facts;
             return against_facts(facts, {&c.bad}, {&c.good}, c.error, linear<AgainstOptions>());
         }},
        {"against_facts", "new",
         [](const Call& c) {
             AgainstFacts facts;
             return against_facts(facts, {&c.good}, {&c.bad}, c.error, linear<AgainstOptions>());
         }},
        {"attribute", "reference",
         [](const Call& c) {
             AttributeResult found;
             return attribute(found, {&c.bad}, {&c.good}, c.error, linear<AttributeOptions>());
         }},
        {"attribute", "test",
         [](const Call& c) {
             AttributeResult found;
             return attribute(found, {&c.good}, {&c.bad}, c.error, linear<AttributeOptions>());
         }},
        {"qc_facts", "alone",
         [](const Call& c) {
             QcFacts facts;
             return qc_facts(facts, {&c.bad}, c.error, linear<QcOptions>());
         }},
        {"qc_facts", "another part",
         [](const Call& c) {
             QcFacts facts;
             return qc_facts(facts, {&c.good, &c.bad}, c.error, linear<QcOptions>());
         }},
        {"write_image", "", [](const Call& c) { return write_image(c.bad, c.file, c.error); }},
        {"write_images", "second",
         [](const Call& c) {
             return write_images({{&c.good, c.good.spec()}, {&c.bad, c.bad.spec()}}, c.file,
                                 c.error);
         }},
        {"write_texture", "",
         [](const Call& c) {
             return write_texture(OIIO::ImageBufAlgo::MakeTxTexture, c.bad, c.file,
                                  OIIO::ImageSpec(), c.error);
         }},
    };
}

std::vector<Function> functions() {
    std::vector<Function> all = comparisons();
    for (const auto& more : {pictures(), numbers_and_files()})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

void expect_refused(const Function& function, const DamagedFile& file, const ImageBuf& bad,
                    const ImageBuf& good, const Folder& folder) {
    SCOPED_TRACE(std::string(function.name) + " " + function.how);
    ImageBuf dst;
    std::string error;
    const std::string target = folder / "target.exr";
    EXPECT_FALSE(function.run({bad, good, dst, error, target}));
    EXPECT_FALSE(dst.initialized());
    EXPECT_EQ(dst.localpixels(), nullptr);
    if (error.empty())
        error = dst.geterror();
    EXPECT_EQ(error, valid_utf8(error));
    EXPECT_FALSE(OIIO::Filesystem::remove(target)) << "it was written";
    if (file.named && (!function.layers || file.layers))
        EXPECT_THAT(error, HasSubstr(valid_utf8(file.path)));
}

TEST(Damaged, FilesThatWereNotReadMakeNoResult) {
    const Folder folder;
    const DamagedFiles files(folder);
    const ImageBuf good = DamagedFiles::whole();
    for (const DamagedFile& file : files.all()) {
        SCOPED_TRACE(file.path);
        for (const Function& function : functions()) {
            const UnreadFile bad(file.path);
            expect_refused(function, file, bad.image, good, folder);
        }
    }
}

TEST(Damaged, FailedReadsMakeNoResultEvenIfTheirErrorWasTaken) {
    const Folder folder;
    const DamagedFiles files(folder);
    const ImageBuf good = DamagedFiles::whole();
    int tried = 0;
    for (const DamagedFile& file : files.all()) {
        SCOPED_TRACE(file.path);
        ImageBuf bad(file.path);
        // OpenImageIO takes the ends of some formats as black, without a word.
        if (file.large || bad.read(0, 0, true))
            continue;
        (void)bad.geterror();
        ++tried;
        for (const Function& function : functions())
            expect_refused(function, file, bad, good, folder);
    }
    EXPECT_GE(tried, 20);
}

TEST(Damaged, AnImageThatWasNeverAnythingMakesNoResult) {
    const Folder folder;
    const ImageBuf nothing, good = DamagedFiles::whole();
    for (const Function& function : functions()) {
        const DamagedFile nowhere{"", false, true, false};
        expect_refused(function, nowhere, nothing, good, folder);
    }
}

// A function that is added takes its place in the table above.
TEST(Damaged, TheTableHasEveryFunctionThatTakesImages) {
    std::set<std::string> declared, listed;
    const std::regex function(R"((\w+)\(([^;]*)\);)");
    for (const auto& header :
         std::filesystem::directory_iterator(TESTIMAGES_DIR "/../src/include/tonetool")) {
        std::string text = std::regex_replace(bytes_of(header.path()), std::regex("//[^\n]*"), "");
        for (size_t at = text.find("TONETOOL_API"); at != std::string::npos;
             at = text.find("TONETOOL_API", at + 1)) {
            const std::string rest = text.substr(at, text.find(';', at) + 1 - at);
            std::smatch found;
            if (std::regex_search(rest, found, function) &&
                (found[2].str().find("ImageBuf") != std::string::npos ||
                 found[2].str().find("OutputImage") != std::string::npos))
                declared.insert(found[1]);
        }
    }
    for (const Function& entry : functions())
        listed.insert(entry.name);
    EXPECT_EQ(listed, declared);
}

} // namespace
} // namespace tonetool
