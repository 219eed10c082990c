// SPDX-License-Identifier: BSD-3-Clause
// bias_check() and noise_floor() against the results of the method's reference implementation
// (numpy, double precision): on renders below SHARED_DIR, and on the synthetic ones of
// bias_pictures.h, made by make_bias_goldens.py.
#include <OpenImageIO/imagebuf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "bias_pictures.h"
#include "metrics/noise_floor.h"
#include "metrics/refusal.h"

namespace tonetool::metrics {
namespace {

using json = nlohmann::json;
using kernels::in_order;

std::string shared_dir() {
    const char* dir = std::getenv("SHARED_DIR");
    return dir ? std::string(dir) + "/" : "";
}

json read_json(const std::string& path) {
    std::ifstream in(path);
    return in ? json::parse(in) : json();
}

json goldens() {
    return read_json(shared_dir() + "golden/noise/goldens.json");
}

// The beauty of a render of the scenes.
struct Picture {
    int width = 0, height = 0;
    std::vector<float> plane[3];

    explicit Picture(const std::string& path) {
        OIIO::ImageBuf image(path);
        width = image.spec().width;
        height = image.spec().height;
        const char* const names[3] = {"R", "G", "B"};
        for (int c = 0; c < 3; ++c) {
            int channel = image.spec().channelindex(names[c]);
            if (channel < 0)
                channel = image.spec().channelindex(std::string("ViewLayer.Combined.") + names[c]);
            plane[c].resize(size_t(width) * size_t(height));
            const OIIO::ROI one(0, width, 0, height, 0, 1, channel, channel + 1);
            if (channel < 0 || !image.get_pixels(one, OIIO::TypeDesc::FLOAT, plane[c].data()))
                throw std::runtime_error(path + ": " + image.geterror());
        }
    }
    kernels::ConstRgb view() const {
        return {{plane[0].data(), plane[1].data(), plane[2].data()}, width, width, height, 0};
    }
};

BiasSide side_of(const json& files) {
    const Picture first(shared_dir() + files[0].get<std::string>());
    BiasSide side(first.width, first.height);
    side.add(first.view(), in_order());
    for (size_t i = 1; i < files.size(); ++i)
        side.add(Picture(shared_dir() + files[i].get<std::string>()).view(), in_order());
    return side;
}

double number(const json& value) {
    if (!value.is_string())
        return value.get<double>();
    const double inf = std::numeric_limits<double>::infinity();
    return value == "inf" ? inf : value == "-inf" ? -inf : std::nan("");
}

// The README of the goldens: 1e-6 relative, 1e-9 near 0; only the order of the sums differs.
void expect_number(double got, const json& value, const std::string& what) {
    const double want = number(value);
    if (std::isinf(want))
        EXPECT_EQ(got, want) << what;
    else
        EXPECT_NEAR(got, want, 1e-9 + 1e-6 * std::abs(want)) << what;
}

// Tails below 1e-12 by their logarithm.
void expect_tail(double got, const json& value, const std::string& what) {
    const double want = number(value);
    if (want > 0 && want < 1e-12)
        EXPECT_NEAR(std::log10(got), std::log10(want), 1e-4) << what;
    else
        expect_number(got, value, what);
}

template <class Values, class Expect>
void expect_table(const Values& got, const json& rows, const std::string& what,
                  const Expect& expect) {
    size_t at = 0;
    for (const json& row : rows)
        for (const json& want : row) {
            ASSERT_LT(at, got.size()) << what;
            expect(got[at], want, what + " " + std::to_string(at));
            ++at;
        }
    EXPECT_EQ(at, got.size()) << what;
}

void expect_mask(uint8_t got, const json& want, const std::string& what) {
    EXPECT_EQ(got != 0, want.get<bool>()) << what;
}

void expect_scale(const BiasScale& got, const json& want, const std::string& what) {
    const BiasScale::Channel& y = got.channel[0];
    expect_table(y.mean, want["mean"], what + " mean", expect_number);
    expect_table(y.se, want["se"], what + " se", expect_number);
    expect_table(y.t, want["t"], what + " t", expect_number);
    expect_table(y.level, want["level"], what + " level", expect_number);
    for (size_t c = 0; c < kBiasChannels; ++c) {
        const std::string channel = what + " " + kBiasChannelNames[c];
        expect_table(got.channel[c].p, want["p"][c], channel + " p", expect_tail);
        expect_table(got.channel[c].rejected, want["rejected"][c], channel, expect_mask);
    }
    ASSERT_EQ(got.structure_p.empty(), !want.contains("structure_p")) << what;
    if (got.structure_p.empty())
        return;
    expect_table(got.structure_p, want["structure_p"], what + " structure", expect_tail);
    expect_table(got.structure_rejected, want["structure_rejected"], what, expect_mask);
}

void expect_gain(const BiasGain& got, const json& want, const std::string& what) {
    expect_number(got.gain, want["gain"], what + " gain");
    expect_number(got.se, want["se"], what + " se");
    expect_number(got.z, want["z"], what + " z");
    expect_tail(got.p, want["p"], what + " p");
    expect_number(got.energy, want["energy"], what + " energy");
    expect_number(got.energy_se, want["energy_se"], what + " energy_se");
}

const char* name_of(BiasVerdict verdict) {
    switch (verdict) {
    case BiasVerdict::Different:
        return "different";
    case BiasVerdict::Equal:
        return "equal";
    case BiasVerdict::NotEnoughSamples:
        break;
    }
    return "not enough samples";
}

void expect_statistics(const BiasResult& got, const json& want) {
    expect_number(got.asymmetry, want["asymmetry"], "asymmetry");
    EXPECT_EQ(got.unlike, want["unlike"].get<int>());
    expect_number(got.correlation, want["correlation"], "correlation");
    EXPECT_EQ(got.correlated, want["correlated"].get<bool>());
    for (size_t c = 0; c < kBiasChannels; ++c) {
        expect_number(got.rare[c], want["rare"][c], "rare");
        expect_gain(got.gain[c], want["gain"][kBiasChannelNames[c]], kBiasChannelNames[c]);
    }
    EXPECT_EQ(got.untested, want["untested"].get<int64_t>());
    EXPECT_EQ(got.tested, want["tests"].get<int64_t>());
    expect_number(got.absolute, want["absolute"], "absolute");
    ASSERT_EQ(got.more.has_value(), !want["more"].is_null());
    if (got.more)
        expect_number(*got.more, want["more"], "more");
}

void expect_result(const BiasResult& got, const json& want) {
    EXPECT_EQ(name_of(got.verdict), want["verdict"].get<std::string>());
    EXPECT_EQ(got.width, want["width"].get<int>());
    EXPECT_EQ(got.height, want["height"].get<int>());
    EXPECT_EQ((std::vector<int>{got.references, got.tests}), want["seeds"].get<std::vector<int>>());
    ASSERT_EQ(got.judged, want.contains("asymmetry"));
    if (want.contains("bound")) {
        EXPECT_EQ(bias_evidence(got), want["evidence"].get<std::vector<std::string>>());
        expect_number(got.bound, want["bound"], "bound");
        expect_number(got.shown, want["shown"], "shown");
    }
    if (got.judged)
        expect_statistics(got, want);
}

BiasTest options_of(const json& one) {
    BiasTest options;
    options.within = one.value("within", options.within);
    options.alpha = one.value("alpha", options.alpha);
    options.power = one.value("power", options.power);
    return options;
}

TEST(BiasGoldens, RendersOfTheScenes) {
    const json all = goldens();
    if (all.is_null())
        GTEST_SKIP() << "no golden/noise/goldens.json below SHARED_DIR (\"" << shared_dir()
                     << "\"): bias_check() is not compared with its reference implementation";
    ASSERT_EQ(all["cases"].size(), 12u);
    for (const json& one : all["cases"]) {
        SCOPED_TRACE(one["name"].get<std::string>());
        const BiasResult got = bias_check(side_of(one["ref"]), side_of(one["test"]),
                                          options_of(one["options"]), in_order());
        const json& want = one["result"];
        expect_result(got, want);
        if (HasFatalFailure())
            return;
        for (size_t s = 0; got.judged && s < kBiasScales; ++s) {
            const std::string block = std::to_string(kBiasBlocks[s]);
            expect_scale(got.scales[s], want["maps"][block], block);
        }
    }
}

template <class Values>
double sum_of(const Values& values) {
    double sum = 0;
    for (const auto value : values)
        sum += std::isfinite(double(value)) ? std::abs(double(value)) : 0;
    return sum;
}

void expect_digest(const BiasScale& got, const json& want) {
    const BiasScale::Channel& y = got.channel[0];
    expect_number(sum_of(y.mean), want["mean"], "mean");
    expect_number(sum_of(y.se), want["se"], "se");
    expect_number(sum_of(y.t), want["t"], "t");
    expect_number(sum_of(y.level), want["level"], "level");
    for (size_t c = 0; c < kBiasChannels; ++c) {
        const BiasScale::Channel& channel = got.channel[c];
        expect_number(sum_of(channel.p), want["p"][c], "p");
        expect_number(sum_of(channel.rejected), want["rejected"][c], "rejected");
        expect_number(double(channel.tested.size()) - sum_of(channel.tested), want["untested"][c],
                      "untested");
    }
    ASSERT_EQ(got.structure_p.empty(), !want.contains("structure_p"));
    if (got.structure_p.empty())
        return;
    expect_number(sum_of(got.structure_p), want["structure_p"], "structure_p");
    EXPECT_EQ(got.structures, want["structures"].get<int64_t>());
}

std::vector<Render> renders_of(const json& one, int width, int height) {
    RenderOptions o;
    o.noise = one.value("noise", o.noise);
    o.power = one.value("power", o.power);
    o.fireflies = one.value("fireflies", o.fireflies);
    o.gain = one.value("gain", o.gain);
    o.corner = one.value("corner", o.corner);
    o.smooth = one.value("smooth", o.smooth);
    o.level = one.value("level", o.level);
    o.shift = one.value("shift", o.shift);
    o.black_half = one.value("black_half", o.black_half);
    o.wave = one.value("wave", o.wave);
    std::vector<Render> out;
    for (const json& seed : one["seeds"])
        out.emplace_back(width, height, seed.get<uint64_t>(), o);
    return out;
}

TEST(BiasGoldens, SyntheticRenders) {
    const json all = read_json(UNIT_METRICS_DIR "/bias_goldens.json");
    ASSERT_EQ(all.size(), 25u);
    for (const json& one : all) {
        SCOPED_TRACE(one["name"].get<std::string>());
        const int width = one["width"], height = one["height"];
        const BiasSide reference = side_of(renders_of(one["reference"], width, height));
        const BiasSide test = side_of(renders_of(one["test"], width, height));
        const BiasResult got = bias_check(reference, test, options_of(one["options"]), in_order());
        expect_result(got, one["result"]);
        if (HasFatalFailure())
            return;
        for (size_t s = 0; got.judged && s < kBiasScales; ++s)
            expect_digest(got.scales[s], one["result"]["scales"][s]);
    }
}

TEST(BiasGoldens, Limits) {
    const json all = goldens();
    if (all.is_null())
        GTEST_SKIP() << "no golden/noise/goldens.json below SHARED_DIR (\"" << shared_dir()
                     << "\"): noise_floor() is not compared with its reference implementation";
    ASSERT_EQ(all["limits"].size(), 6u);
    for (const json& one : all["limits"]) {
        NoiseFloorOptions options;
        options.content = one["content"];
        options.confidence = one["confidence"];
        const auto values = one["values"].get<std::vector<double>>();
        const json& want = one["result"];
        if (want["limit"].is_null()) {
            EXPECT_THROW(noise_floor(values, options), Refusal);
            continue;
        }
        const NoiseFloor got = noise_floor(values, options);
        expect_number(got.limit, want["limit"], want["method"]);
        EXPECT_EQ(got.needed, want["needed"].get<int64_t>());
        EXPECT_EQ(got.rank > 0, want["method"].get<std::string>().rfind("order", 0) == 0);
    }
}

} // namespace
} // namespace tonetool::metrics
