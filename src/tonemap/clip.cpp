// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/clip.h"

#include <algorithm>

namespace tonetool::tonemap {
namespace {

using Rgb = std::array<double, 3>;

// How fast Clip::Neutral becomes white above 1, as in Khronos' PBR neutral tone mapper, where this
// is 0.15.
constexpr double kDesaturation = 0.3;
// Saturations from which on Clip::Hue begins to leave Clip::Luminance, and has left it.
constexpr double kNearlyWhite = 0.7, kSaturated = 0.95;

// On the line from grey of the same luminance to the colour, where its largest channel is 1.
Rgb with_luminance(const Rgb& c, double lum, double peak) {
    const double share = peak > lum ? std::clamp((1 - lum) / (peak - lum), 0.0, 1.0) : 0;
    Rgb out;
    for (size_t i = 0; i < 3; ++i)
        out[i] = std::min(lum, 1.0) + share * (c[i] - lum);
    return out;
}

Rgb with_hue(const Rgb& c, double peak) {
    const double white = 1 - 1 / (kDesaturation * (peak - 1) + 1);
    Rgb out;
    for (size_t i = 0; i < 3; ++i)
        out[i] = c[i] / peak + white * (1 - c[i] / peak);
    return out;
}

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

} // namespace

void clip_color(Clip how, const Rgb& weights, float (&rgb)[3]) {
    for (float& v : rgb)
        v = v > 0 ? v : 0;
    const float largest = std::max({rgb[0], rgb[1], rgb[2]});
    if (!(largest > 1))
        return;
    const Rgb c{double(rgb[0]), double(rgb[1]), double(rgb[2])};
    const double peak = double(largest);
    const double lum = weights[0] * c[0] + weights[1] * c[1] + weights[2] * c[2];
    Rgb out = c;
    if (how == Clip::Luminance)
        out = with_luminance(c, lum, peak);
    if (how == Clip::Neutral)
        out = with_hue(c, peak);
    if (how == Clip::Hue) {
        const double saturation = 1 - std::min({c[0], c[1], c[2]}) / peak;
        const double share = smooth_step(kNearlyWhite, kSaturated, saturation);
        const Rgb a = with_luminance(c, lum, peak), b = with_hue(c, peak);
        for (size_t i = 0; i < 3; ++i)
            out[i] = (1 - share) * a[i] + share * b[i];
    }
    for (size_t i = 0; i < 3; ++i)
        rgb[i] = float(std::clamp(out[i], 0.0, 1.0));
}

} // namespace tonetool::tonemap
