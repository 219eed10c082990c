// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/bias_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;
using Color = std::array<float, 3>; // sRGB-encoded

constexpr Color kFaintBlue{0.82f, 0.90f, 0.95f}, kBlue{0.09f, 0.31f, 0.58f};
constexpr Color kFaintOrange{1.0f, 0.89f, 0.74f}, kOrange{0.70f, 0.32f, 0.02f};
constexpr Color kGrey{0.42f, 0.42f, 0.42f}, kDarkGrey{0.24f, 0.24f, 0.24f},
    kWhite{0.95f, 0.95f, 0.95f};
constexpr int kStripe = 4; // pixels

Color mixed(const Color& a, const Color& b, float t) {
    Color out{};
    for (size_t c = 0; c < 3; ++c)
        out[c] = a[c] + t * (b[c] - a[c]);
    return out;
}

Color color_of(double difference, double range) {
    const auto t = float(std::min(std::abs(difference) / range, 1.0));
    return difference < 0 ? mixed(kFaintBlue, kBlue, t) : mixed(kFaintOrange, kOrange, t);
}

int channel(const ImageBuf& map, const char* name) {
    const auto& names = map.spec().channelnames;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw std::runtime_error(std::string("the map has no channel ") + name);
    return int(found - names.begin());
}

ImageBuf picture_of_size(int width, int height) {
    return ImageBuf(OIIO::ImageSpec(width, height, 3, OIIO::TypeFloat));
}

} // namespace

double bias_range(const ImageBuf& map, double least) {
    const int difference = channel(map, "difference"), means = channel(map, "means");
    double largest = least;
    for (ImageBuf::ConstIterator<float> p(map); !p.done(); ++p)
        if (p[means] > 0)
            largest = std::max(largest, double(std::abs(p[difference])));
    return std::min(largest, 1.0);
}

ImageBuf bias_picture(const ImageBuf& map, const PixelSize& side, double range) {
    const int difference = channel(map, "difference"), means = channel(map, "means"),
              structures = channel(map, "structures");
    const OIIO::ROI region = map.roi();
    ImageBuf picture = picture_of_size(side.width, side.height);
    for (ImageBuf::Iterator<float> p(picture); !p.done(); ++p) {
        // Blocks are large beside a pixel of the picture: the nearest one says it all.
        const int x = region.xbegin + int(int64_t(p.x()) * region.width() / side.width);
        const int y = region.ybegin + int(int64_t(p.y()) * region.height() / side.height);
        const bool stripe = (p.x() + p.y()) / kStripe % 2 == 0;
        const float found = map.getchannel(x, y, 0, means);
        Color color = kGrey;
        if (found > 0)
            color = color_of(double(map.getchannel(x, y, 0, difference)), range);
        else if (map.getchannel(x, y, 0, structures) > 0)
            color = stripe ? kWhite : kGrey;
        else if (found < 0)
            color = stripe ? kDarkGrey : kGrey;
        for (int c = 0; c < 3; ++c)
            p[c] = color[size_t(c)];
    }
    return picture;
}

ImageBuf bias_ramp() {
    constexpr int width = 256;
    ImageBuf ramp = picture_of_size(width, 1);
    for (ImageBuf::Iterator<float> p(ramp); !p.done(); ++p) {
        const Color color = color_of((2.0 * p.x() - (width - 1)) / (width - 1), 1);
        for (int c = 0; c < 3; ++c)
            p[c] = color[size_t(c)];
    }
    return ramp;
}

} // namespace tonetool::sequence
