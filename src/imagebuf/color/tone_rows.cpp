// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/tone_rows.h"

#include <OpenImageIO/strutil.h>
#include <cmath>

#include "kernels/tone_curve.h"
#include "tonetool/tonemap.h"

namespace tonetool {
namespace {

struct NamedEncoding {
    const char* name;
    Encoding encode;
    double (*decode)(double);
    const char* space;
};

const NamedEncoding kEncodings[] = {
    {"none", [](float v) { return v; }, [](double v) { return v; }, "lin_rec709"},
    {"srgb", [](float v) { return float(linear_to_srgb(double(v))); }, srgb_to_linear, "sRGB"},
    {"gamma2.2", [](float v) { return std::pow(v, 1.0f / 2.2f); },
     [](double v) { return std::pow(v, 2.2); }, "GammaCorrected2.2"},
    {"rec1886", [](float v) { return std::pow(v, 1.0f / 2.4f); },
     [](double v) { return std::pow(v, 2.4); }, "GammaCorrected2.4"},
    {"gamma2.6", [](float v) { return std::pow(v, 1.0f / 2.6f); },
     [](double v) { return std::pow(v, 2.6); }, "GammaCorrected2.6"}};

// What colour is divided by.
float divisor(const float* pixel, const ToneChannels& which) {
    const float alpha = which.alpha < 0 || !which.unpremult ? 1.0f : pixel[which.alpha];
    return std::isfinite(alpha) && alpha > 0 ? alpha : 1.0f;
}

} // namespace

ToneRow::ToneRow(size_t width) : factor(width, 1.0f), alpha(width, 1.0f) {
    for (int c = 0; c < 3; ++c) {
        plane[c].resize(width);
        rgb[c] = plane[c].data();
    }
}

std::string nonfinite_warning(int64_t pixels) {
    return OIIO::Strutil::fmt::format("{} pixel(s) are not finite: NaN and -Inf became 0, +Inf {}",
                                      pixels, kInfinityStandsFor);
}

void take_row(const float* pixels, int channels, const ToneChannels& which, ToneRow& row,
              size_t count, ToneCounts& counts) {
    for (size_t x = 0; x < count; ++x, pixels += channels) {
        const float alpha = divisor(pixels, which);
        if (which.alpha >= 0 && !which.unpremult)
            row.alpha[x] = pixels[which.alpha];
        bool good = true;
        for (int c = 0; c < 3; ++c) {
            const float v = pixels[which.rgb[c]];
            good = good && std::isfinite(v);
            row.rgb[c][x] = light_to_show(light_to_show(v) / alpha);
        }
        counts.nonfinite += !good;
    }
}

void put_row(const ToneRow& row, size_t count, const ToneChannels& which, float* pixels,
             int channels) {
    const bool grey = which.rgb[0] == which.rgb[1] && which.rgb[0] == which.rgb[2];
    for (size_t x = 0; x < count; ++x, pixels += channels) {
        const float alpha = divisor(pixels, which);
        double luminance = 0;
        for (int c = 0; c < 3; ++c) {
            pixels[which.rgb[c]] = light_to_show(row.rgb[c][x]) * alpha;
            luminance += kernels::kLuminance[c] * double(pixels[which.rgb[c]]);
        }
        if (grey)
            pixels[which.rgb[0]] = float(luminance);
    }
}

void linearize_row(const ColorSpace& space, bool rec709, ToneRow& row, size_t count,
                   ToneCounts& counts) {
    const bool convert = rec709 && !space.is_rec709;
    for (size_t x = 0; x < count; ++x) {
        double v[3];
        for (int c = 0; c < 3; ++c)
            v[c] = space.light(double(row.rgb[c][x]), double(row.alpha[x]));
        bool negative = false;
        for (size_t c = 0; c < 3; ++c) {
            const auto& m = space.to_rec709[c];
            const double sum = convert ? m[0] * v[0] + m[1] * v[1] + m[2] * v[2] : v[c];
            negative = negative || sum < 0;
            row.rgb[c][x] = float(sum > 0 ? sum : 0.0);
        }
        counts.negative += negative;
    }
}

Encoding find_encoding(const std::string& name) {
    for (const NamedEncoding& entry : kEncodings)
        if (name == entry.name)
            return entry.encode;
    return nullptr;
}

double (*find_decoding(const std::string& name))(double) {
    for (const NamedEncoding& entry : kEncodings)
        if (name == entry.name)
            return entry.decode;
    return nullptr;
}

std::string space_of_encoding(const std::string& name) {
    for (const NamedEncoding& entry : kEncodings)
        if (name == entry.name)
            return entry.space;
    return {};
}

std::vector<std::string> ToneAlgo::display_encodings() {
    std::vector<std::string> names;
    for (const NamedEncoding& entry : kEncodings)
        names.emplace_back(entry.name);
    return names;
}

} // namespace tonetool
