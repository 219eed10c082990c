// SPDX-License-Identifier: BSD-3-Clause
// Takes rows of an image apart for a tone curve or a view, and puts them back.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "imagebuf/pixels/colorimetry.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// What a row's pixels are before and after.
struct ToneRow {
    std::vector<float> plane[3]; ///< R, G, B
    std::vector<float> factor;   ///< what they are multiplied by
    std::vector<float> alpha;    ///< 1 where there is none
    float* rgb[3] = {nullptr, nullptr, nullptr};
    explicit ToneRow(size_t width);
};

/// Counts of what was found, each pixel once.
struct ToneCounts {
    int64_t nonfinite = 0, negative = 0;
};

/// Which channels of the float pixels of an image are mapped.
struct ToneChannels {
    int rgb[3];             ///< all the same for a picture of one channel
    int alpha;              ///< -1: none
    bool unpremult = false; ///< colour is divided by alpha and multiplied with it
};

/// What stands for +Inf: the largest half.
inline constexpr float kInfinityStandsFor = 65504.0f;

/// NaN and -Inf become 0, +Inf kInfinityStandsFor.
inline float light_to_show(float v) {
    return std::isfinite(v) ? v : v > 0 ? kInfinityStandsFor : 0.0f;
}

/// What is said of that many pixels that were shown so.
std::string nonfinite_warning(int64_t pixels);

/// Takes the colour of `count` pixels out of a row, divided by alpha. NaN and -Inf become 0, +Inf
/// kInfinityStandsFor; counted in `counts`.
void take_row(const float* pixels, int channels, const ToneChannels& which, ToneRow& row,
              size_t count, ToneCounts& counts);
/// Puts it back, multiplied by alpha; the luminance where there is one channel.
void put_row(const ToneRow& row, size_t count, const ToneChannels& which, float* pixels,
             int channels);

/// To linear light, in Rec.709 if `rec709`, else in the primaries of `space`; negative components
/// become 0 and are counted.
void linearize_row(const ColorSpace& space, bool rec709, ToneRow& row, size_t count,
                   ToneCounts& counts);

/// An encoding by its name, of display light >= 0; null: there is none of that name.
using Encoding = float (*)(float);
Encoding find_encoding(const std::string& name);
/// What brings its code values >= 0 back to light; null: there is none of that name.
double (*find_decoding(const std::string& name))(double);
/// What `oiio:ColorSpace` says of Rec.709 so encoded.
std::string space_of_encoding(const std::string& name);

} // namespace tonetool
