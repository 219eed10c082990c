// SPDX-License-Identifier: BSD-3-Clause
// A small render with light groups, Cryptomatte, depth and albedo, and what attribute() says of it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "files.h"
#include "metrics/coverage.h"
#include "tonetool/attribute.h"

namespace tonetool {

/// Two lights on a floor, with a box and a ball, ids, depth, an albedo.
struct Render {
    static constexpr int kWidth = 48, kHeight = 32;

    std::map<std::string, float> lights{{"key", 1.f}, {"fill", 0.25f}}; ///< by group, their power
    std::array<float, 3> ball_color{0.5f, 0.5f, 0.5f};
    int ball_x = 8;
    bool ball = true;
    std::string manifest_file; ///< instead of the header
    std::map<std::string, std::string> attributes;

    bool is_ball(int x, int y) const {
        return ball && x >= ball_x && x < ball_x + 10 && y >= 10 && y < 22;
    }
    static bool is_box(int x, int y) { return x >= 30 && x < 42 && y >= 6 && y < 26; }
    const char* object(int x, int y) const {
        return is_ball(x, y) ? "ball" : is_box(x, y) ? "box" : "floor";
    }
    std::string manifest() const {
        nlohmann::ordered_json json;
        for (const char* name : {"floor", "box", "ball", "hidden"})
            if (ball || std::strcmp(name, "ball") != 0)
                json[name] = OIIO::Strutil::fmt::format("{:08x}", metrics::cryptomatte_id(name));
        return json.dump();
    }

    ImageBuf image() const {
        std::vector<std::string> channels{"View.Combined.R", "View.Combined.G", "View.Combined.B"};
        for (const auto& [name, power] : lights)
            for (const char* c : {".R", ".G", ".B"})
                channels.push_back("View.Combined_" + name + c);
        for (const char* more : {"View.Depth.Z", "View.DiffCol.R", "View.DiffCol.G",
                                 "View.DiffCol.B", "View.CryptoObject00.r", "View.CryptoObject00.g",
                                 "View.CryptoObject00.b", "View.CryptoObject00.a"})
            channels.emplace_back(more);
        ImageSpec spec = make_spec(kWidth, kHeight, channels);
        const std::string start = "cryptomatte/1234567/";
        spec.attribute(start + "name", "View.CryptoObject");
        spec.attribute(start + "hash", "MurmurHash3_32");
        spec.attribute(start + "conversion", "uint32_to_float32");
        spec.attribute(manifest_file.empty() ? start + "manifest" : start + "manif_file",
                       manifest_file.empty() ? manifest() : manifest_file);
        for (const auto& [name, value] : attributes)
            spec.attribute(start + name, value);
        ImageBuf buf(spec);
        for (ImageBuf::Iterator<float> p(buf); !p.done(); ++p)
            paint(p);
        return buf;
    }

private:
    void paint(ImageBuf::Iterator<float>& p) const {
        const std::string name = object(p.x(), p.y());
        const std::array<float, 3> color =
            name == "ball" ? ball_color : std::array<float, 3>{0.8f, 0.7f, 0.6f};
        int c = 3;
        std::array<float, 3> sum{};
        for (const auto& [light, power] : lights)
            for (size_t k = 0; k < 3; ++k) {
                // Each light falls off to its own side.
                const int way = light == "key" ? p.x() : kWidth - p.x();
                const float value = power * color[k] * float(4 + way) / 32;
                p[c++] = value;
                sum[k] += value;
            }
        for (size_t k = 0; k < 3; ++k)
            p[int(k)] = sum[k];
        p[c++] = name == "ball" ? 3.f : name == "box" ? 4.f : 6.f;
        for (const float albedo : color)
            p[c++] = albedo;
        const uint32_t id = metrics::cryptomatte_id(name);
        float bits = 0;
        std::memcpy(&bits, &id, sizeof bits);
        p[c++] = bits;
        p[c] = 1;
    }
};

inline AttributeResult attributed(const ImageBuf& reference, const ImageBuf& test,
                                  const AttributeOptions& options = {}, int nthreads = 1) {
    AttributeResult result;
    std::string error;
    EXPECT_TRUE(
        ToneAlgo::attribute(result, {&reference}, {&test}, error, options, nullptr, nthreads))
        << error;
    return result;
}
inline AttributeResult attributed(const Render& reference, const Render& test) {
    return attributed(reference.image(), test.image());
}

inline std::string refused(const ImageBuf& reference, const ImageBuf& test,
                           const AttributeOptions& options = {}) {
    AttributeResult result;
    std::string error;
    EXPECT_FALSE(ToneAlgo::attribute(result, {&reference}, {&test}, error, options));
    return error;
}

/// Names of rows with a finding.
template <class Rows>
std::map<std::string, std::string> findings(const Rows& rows) {
    std::map<std::string, std::string> found;
    for (const auto& row : rows)
        if (!row.finding.empty())
            found[row.name] = row.finding;
    return found;
}
using Found = std::map<std::string, std::string>;

} // namespace tonetool
