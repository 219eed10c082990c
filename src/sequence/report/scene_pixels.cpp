// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/scene_pixels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sequence/report/pixel_rows.h"
#include "tonetool/tonemap.h"

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::TypeDesc;

using Halves = std::vector<uint16_t>;

constexpr uint16_t kInfinity = 0x7c00, kLargest = 0x7bff, kMagnitude = 0x7fff;

// The channels as they are stored, in the order they are asked for.
Halves halves_of(const ImageBuf& image, const ROI& region, const std::vector<int>& channels) {
    const size_t along = size_t(region.width()) * channels.size();
    Halves values(along * size_t(region.height()));
    PixelRows rows(image, region, channels);
    uint16_t* to = values.data();
    for (int y = region.ybegin; y < region.yend; ++y, to += along)
        half_bits(rows.read(y), to);
    return values;
}

// Of three channels that reduced_color() has made.
ImageBuf in_rec709(const ImageBuf& image, const PixelOptions& options) {
    TonemapOptions linear;
    linear.pixels = options;
    linear.pixels.layer.clear();
    if (!says_space_again(options))
        linear.pixels.from.clear();
    linear.curve.name = "linear";
    linear.encode = "none";
    linear.clamp = false;
    ImageBuf result;
    if (!ToneAlgo::tonemap(result, image, linear))
        throw std::runtime_error(result.geterror());
    return result;
}

bool is_plain(const ImageBuf& image, const ColorChoice& choice) {
    return choice.space == "rec709" && !choice.display_encoded &&
           !image.spec().find_attribute("hdr:exposure");
}

ColorChoice chosen_color(const ImageBuf& image, const PixelOptions& options) {
    ColorChoice choice;
    std::string error;
    if (!ToneAlgo::find_color(image.spec(), options, choice, error))
        throw std::runtime_error(error);
    return choice;
}

ScenePixels sized(const PixelSize& side, Halves color) {
    ScenePixels pixels;
    pixels.width = side.width;
    pixels.height = side.height;
    pixels.color = std::move(color);
    return pixels;
}

template <class Code>
ImageBuf coded(const ScenePixels& pixels, const Code& code) {
    ImageBuf picture(OIIO::ImageSpec(pixels.width, pixels.height, 3, TypeDesc::UINT8),
                     OIIO::InitializePixels::No);
    std::transform(pixels.color.begin(), pixels.color.end(),
                   static_cast<uint8_t*>(picture.localpixels()), code);
    return picture;
}

std::vector<float> value_table() {
    std::vector<float> values(65536);
    for (size_t half = 0; half < values.size(); ++half)
        values[half] = half_value(uint16_t(half));
    return values;
}

// Sums over the pixels of one row that is reduced.
class MeanRow {
public:
    explicit MeanRow(int width) : m_sums(size_t(width) * 3), m_counts(size_t(width)) {}

    /// `columns`: the pixel that each one of the row falls on.
    void add(const uint16_t* row, const std::vector<size_t>& columns) {
        static const std::vector<float> values = value_table();
        for (const size_t at : columns) {
            const bool finite = std::max({row[0] & kMagnitude, row[1] & kMagnitude,
                                          row[2] & kMagnitude}) < kInfinity;
            m_counts[at] += finite ? 1 : 0;
            for (size_t c = 0; c < 3 && finite; ++c)
                m_sums[3 * at + c] += values[row[c]];
            row += 3;
        }
    }

    void append_to(std::vector<float>& means) const {
        for (size_t i = 0; i < m_sums.size(); ++i)
            means.push_back(m_counts[i / 3] > 0 ? m_sums[i] / float(m_counts[i / 3]) : 0);
    }

private:
    std::vector<float> m_sums;
    std::vector<int> m_counts;
};

std::vector<uint8_t> log_table() {
    std::vector<uint8_t> codes(65536, 0);
    const double scale = 255 / (kLogHigh - kLogLow);
    for (uint32_t half = 1; half <= kInfinity; ++half) {
        const double stops = std::log2(double(half_value(uint16_t(half)))) - kLogLow;
        codes[half] = uint8_t(std::lround(std::clamp(stops * scale, 0.0, 255.0)));
    }
    return codes;
}

} // namespace

float half_value(uint16_t half) {
    const int exponent = half >> 10 & 31, mantissa = half & 1023;
    const float sign = half >> 15 ? -1.0f : 1.0f;
    if (exponent == 31)
        return mantissa ? std::nanf("") : sign * HUGE_VALF;
    return sign * (exponent == 0 ? std::ldexp(float(mantissa), -24)
                                 : std::ldexp(float(mantissa + 1024), exponent - 25));
}

ScenePixels scene_pixels(const ImageBuf& image, const PixelOptions& options, const ROI& region) {
    const ColorChoice choice = chosen_color(image, options);
    const PixelSize side{region.width(), region.height()};
    ScenePixels pixels = sized(side, halves_of(image, region, {choice.r, choice.g, choice.b}));
    if (!is_plain(image, choice)) {
        const Halves stored = std::move(pixels.color);
        pixels.color = scene_means(image, options, region, side).color;
        for (size_t i = 0; i < stored.size(); ++i)
            if ((stored[i] & kMagnitude) >= kInfinity)
                pixels.color[i] = stored[i];
    }
    if (choice.a >= 0)
        pixels.alpha = halves_of(image, region, {choice.a});
    return pixels;
}

ScenePixels scene_means(const ImageBuf& image, const PixelOptions& options, const ROI& region,
                        const PixelSize& side) {
    ImageBuf means = reduced_color(image, options, region, side);
    if (!is_plain(image, chosen_color(image, options)))
        means = in_rec709(means, options);
    return sized(side, halves_of(means, means.roi(), {0, 1, 2}));
}

ScenePixels reduced(const ScenePixels& pixels, const PixelSize& side) {
    std::vector<float> means;
    means.reserve(size_t(side.width) * size_t(side.height) * 3);
    const std::vector<size_t> columns = targets(pixels.width, side.width);
    int64_t y = 0;
    for (int to = 0; to < side.height; ++to) {
        MeanRow row(side.width);
        for (; y < pixels.height && y * side.height / pixels.height == to; ++y)
            row.add(pixels.color.data() + 3 * y * pixels.width, columns);
        row.append_to(means);
    }
    Halves color(means.size());
    half_bits(means, color.data());
    return sized(side, std::move(color));
}

ScenePixels part_of(const ScenePixels& pixels, const ROI& part) {
    ScenePixels cut = sized({part.width(), part.height()}, {});
    for (int y = part.ybegin; y < part.yend; ++y) {
        const auto row = size_t(y) * size_t(pixels.width);
        const auto from = [&](size_t count) { return long(count * (row + size_t(part.xbegin))); };
        const auto to = [&](size_t count) { return long(count * (row + size_t(part.xend))); };
        const auto &color = pixels.color, &alpha = pixels.alpha;
        cut.color.insert(cut.color.end(), color.begin() + from(3), color.begin() + to(3));
        if (!alpha.empty())
            cut.alpha.insert(cut.alpha.end(), alpha.begin() + from(1), alpha.begin() + to(1));
    }
    return cut;
}

void shorten(std::vector<uint16_t>& halves, int bits) {
    const int dropped = 10 - bits;
    const uint32_t half_step = dropped > 0 ? 1U << (dropped - 1) : 0;
    for (uint16_t& half : halves) {
        const uint32_t magnitude = half & kMagnitude;
        if (magnitude >= kInfinity)
            continue;
        const uint32_t rounded = (magnitude + half_step) >> dropped << dropped;
        half = uint16_t((half & 0x8000U) | std::min<uint32_t>(rounded, kLargest));
    }
}

ImageBuf high_bytes(const ScenePixels& pixels) {
    return coded(pixels, [](uint16_t half) { return uint8_t(half >> 8); });
}

ImageBuf low_bytes(const ScenePixels& pixels) {
    return coded(pixels, [](uint16_t half) { return uint8_t(half & 255); });
}

ImageBuf both_bytes(const std::vector<uint16_t>& halves, int width, int height) {
    std::vector<uint8_t> bytes;
    bytes.reserve(3 * halves.size());
    for (const uint16_t half : halves)
        bytes.insert(bytes.end(), {uint8_t(half >> 8), uint8_t(half & 255), 0});
    ImageBuf picture(OIIO::ImageSpec(width, height, 3, TypeDesc::UINT8));
    picture.set_pixels(picture.roi(), TypeDesc::UINT8, bytes.data());
    return picture;
}

ImageBuf log_codes(const ScenePixels& pixels) {
    static const std::vector<uint8_t> table = log_table();
    return coded(pixels, [](uint16_t half) { return table[half]; });
}

} // namespace tonetool::sequence
