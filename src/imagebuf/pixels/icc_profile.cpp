// SPDX-License-Identifier: BSD-3-Clause
// Whether an ICC profile says sRGB.
#include <OpenImageIO/strutil.h>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "imagebuf/pixels/colorimetry.h"
#include "tonetool/color_tags.h"

namespace tonetool {
namespace {

using Bytes = std::vector<unsigned char>;

// Signed 16.16 numbers and big-endian integers, ISO 15076-1.
constexpr double kFixed = 65536;
constexpr size_t kHeader = 128, kTagEntry = 12, kTypeHeader = 8, kXyzOfTag = 8;
constexpr size_t kColorSpace = 16; // in the header
// sRGB's primaries in the profile connection space, which has the white of D50.
constexpr double kSrgbPrimaries[3][3] = {
    {0.4361, 0.2225, 0.0139}, {0.3851, 0.7169, 0.0971}, {0.1431, 0.0606, 0.7141}};
// Profiles of sRGB differ in the third decimal; those of other spaces in the second.
constexpr double kSamePrimary = 4e-3, kSameCurve = 0.01;

uint32_t integer(const Bytes& from, size_t at, size_t bytes = 4) {
    uint32_t value = 0;
    for (size_t i = 0; i < bytes; ++i)
        value = (value << 8) | (at + i < from.size() ? from[at + i] : 0u);
    return value;
}

double fixed(const Bytes& from, size_t at) {
    return double(int32_t(integer(from, at))) / kFixed;
}

std::string word(const Bytes& from, size_t at) {
    std::string text;
    for (size_t i = at; i < at + 4 && i < from.size(); ++i)
        text += char(from[i]);
    return text;
}

// The data of a tag; empty if there is none, or it lies outside the profile.
Bytes tag(const Bytes& profile, const std::string& name) {
    const size_t count = integer(profile, kHeader);
    for (size_t i = 0; i < count && kHeader + 4 + (i + 1) * kTagEntry <= profile.size(); ++i) {
        const size_t entry = kHeader + 4 + i * kTagEntry;
        const size_t begin = integer(profile, entry + 4), size = integer(profile, entry + 8);
        if (word(profile, entry) == name && begin <= profile.size() &&
            size <= profile.size() - begin)
            return {profile.begin() + ptrdiff_t(begin), profile.begin() + ptrdiff_t(begin + size)};
    }
    return {};
}

// A curve at `x`, NaN where it is of a type that is not known here.
double curve_at(const Bytes& curve, double x) {
    const std::string type = word(curve, 0);
    if (type == "curv") {
        const size_t count = integer(curve, kTypeHeader), first = kTypeHeader + 4;
        if (count == 0)
            return x;
        if (count == 1) // 8.8
            return std::pow(x, double(integer(curve, first, 2)) / 256);
        const double at = x * double(count - 1);
        const auto low = size_t(at);
        const double a = double(integer(curve, first + 2 * low, 2));
        const double b = double(integer(curve, first + 2 * std::min(low + 1, count - 1), 2));
        return (a + (b - a) * (at - double(low))) / 65535;
    }
    if (type != "para")
        return NAN;
    const uint32_t kind = integer(curve, kTypeHeader, 2);
    const auto p = [&](size_t i) { return fixed(curve, kTypeHeader + 4 + 4 * i); };
    const double power = kind == 0 ? x : p(1) * x + p(2);
    const double start = kind == 0 ? 0 : kind < 3 ? -p(2) / p(1) : p(4);
    const double linear = kind < 3 ? (kind == 2 ? p(3) : 0) : p(3) * x + (kind == 4 ? p(6) : 0);
    const double offset = kind == 2 ? p(3) : kind == 4 ? p(5) : 0;
    return x >= start ? std::pow(power, p(0)) + offset : linear;
}

bool is_srgb_curve(const Bytes& curve) {
    for (double x : {0.1, 0.25, 0.5, 0.75})
        if (!(std::abs(curve_at(curve, x) - srgb_to_linear(x)) < kSameCurve))
            return false;
    return true;
}

bool is_srgb(const Bytes& profile) {
    if (word(profile, kColorSpace) == "GRAY")
        return is_srgb_curve(tag(profile, "kTRC"));
    constexpr const char* primaries[3] = {"rXYZ", "gXYZ", "bXYZ"};
    constexpr const char* curves[3] = {"rTRC", "gTRC", "bTRC"};
    for (size_t c = 0; c < 3; ++c) {
        const Bytes xyz = tag(profile, primaries[c]);
        for (size_t i = 0; i < 3; ++i)
            if (xyz.size() < kXyzOfTag + 12 ||
                std::abs(fixed(xyz, kXyzOfTag + 4 * i) - kSrgbPrimaries[c][i]) > kSamePrimary)
                return false;
        if (!is_srgb_curve(tag(profile, curves[c])))
            return false;
    }
    return true;
}

} // namespace

std::optional<std::string> unapplied_profile(const OIIO::ImageSpec& spec) {
    const OIIO::ParamValue* value = spec.find_attribute("ICCProfile");
    if (!value)
        return std::nullopt;
    const auto* data = static_cast<const unsigned char*>(value->data());
    const auto size = size_t(value->datasize());
    if (is_srgb(Bytes(data, data + size)))
        return std::nullopt;
    const std::string name = spec.get_string_attribute("ICCProfile:profile_description");
    return name.empty() ? "without a description" : name;
}

} // namespace tonetool
