// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/bytes.h"

#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "tonetool/display.h"

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;
using OIIO::TypeDesc;

// 65536 steps of linear light are never more than a twentieth of an 8-bit step of sRGB apart.
constexpr int kLightSteps = 65536, kColorSteps = 256;

ImageBuf ramp(int steps) {
    ImageBuf image(OIIO::ImageSpec(steps, 1, 1, OIIO::TypeFloat));
    for (int i = 0; i < steps; ++i) {
        const float value = float(i) / float(steps - 1);
        image.setpixel(i, 0, &value);
    }
    return image;
}

template <class Value>
std::vector<Value> values_of(const ImageBuf& image, TypeDesc type) {
    std::vector<Value> values(size_t(image.roi().npixels()) * size_t(image.nchannels()));
    if (!image.get_pixels(image.roi(), type, values.data()))
        throw std::runtime_error(image.geterror());
    return values;
}

std::vector<uint8_t> light_table() {
    ImageBuf encoded;
    if (!ToneAlgo::encode_srgb(encoded, ramp(kLightSteps)))
        throw std::runtime_error(encoded.geterror());
    return values_of<uint8_t>(encoded, TypeDesc::UINT8);
}

std::vector<uint8_t> color_table(const std::string& colors) {
    ImageBuf encoded;
    if (!ToneAlgo::color_map(encoded, ramp(kColorSteps), colors))
        throw std::runtime_error(encoded.geterror());
    return values_of<uint8_t>(encoded, TypeDesc::UINT8);
}

ImageBuf picture(const ImageBuf& like, const std::vector<uint8_t>& bytes) {
    const OIIO::ROI roi = like.roi();
    ImageBuf image(OIIO::ImageSpec(roi.width(), roi.height(), 3, TypeDesc::UINT8));
    if (!image.set_pixels(image.roi(), TypeDesc::UINT8, bytes.data()))
        throw std::runtime_error(image.geterror());
    return image;
}

// The index of the nearest of evenly spaced steps over [0,1].
size_t step(float value, int steps) {
    return size_t(
        std::lround(std::clamp(std::isnan(value) ? 0.0f : value, 0.0f, 1.0f) * float(steps - 1)));
}

} // namespace

ImageBuf srgb_bytes(const ImageBuf& linear) {
    static const std::vector<uint8_t> table = light_table();
    std::vector<uint8_t> bytes;
    for (const float value : values_of<float>(linear, OIIO::TypeFloat))
        bytes.push_back(table[step(value, kLightSteps)]);
    return picture(linear, bytes);
}

ImageBuf colored_bytes(const ImageBuf& map, const std::string& colors, double low, double high) {
    const std::vector<uint8_t> table = color_table(colors);
    const double scale = 1 / std::max(high - low, 1e-6);
    std::vector<uint8_t> bytes;
    for (const float value : values_of<float>(map, OIIO::TypeFloat)) {
        const size_t at = 3 * step(float((value - low) * scale), kColorSteps);
        bytes.insert(bytes.end(), table.begin() + long(at), table.begin() + long(at) + 3);
    }
    return picture(map, bytes);
}

ImageBuf coded_bytes(const ImageBuf& map, double low, double high) {
    const double scale = 1 / std::max(high - low, 1e-6);
    std::vector<uint8_t> bytes;
    for (const float value : values_of<float>(map, OIIO::TypeFloat))
        bytes.insert(bytes.end(), 3, uint8_t(step(float((value - low) * scale), kColorSteps)));
    return picture(map, bytes);
}

} // namespace tonetool::sequence
