// SPDX-License-Identifier: BSD-3-Clause
// Small images for tests, the same on every machine.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace tonetool {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::ROI;

inline ImageSpec make_spec(int width, int height, const std::vector<std::string>& channels,
                           OIIO::TypeDesc format = OIIO::TypeFloat) {
    ImageSpec spec(width, height, int(channels.size()), format);
    spec.channelnames = channels;
    return spec;
}

/// Noise over eight stops around `middle` in every channel.
inline void fill_noise(ImageBuf& image, uint32_t seed, double middle = 0.5) {
    std::mt19937 random(seed);
    std::vector<float> pixels(size_t(image.spec().image_pixels()) * size_t(image.nchannels()));
    for (float& v : pixels)
        v = float(middle * std::exp2(8.0 * double(random()) / 4294967296.0 - 4.0));
    image.set_pixels(image.roi(), OIIO::TypeFloat, pixels.data());
}

inline ImageBuf noise(const ImageSpec& spec, uint32_t seed, double middle = 0.5) {
    ImageBuf image(spec);
    fill_noise(image, seed, middle);
    return image;
}

inline ImageBuf noise(int width, int height, uint32_t seed) {
    return noise(make_spec(width, height, {"R", "G", "B"}), seed);
}

inline ImageBuf constant(const ImageSpec& spec, const std::vector<float>& pixel) {
    ImageBuf image(spec);
    for (ImageBuf::Iterator<float> p(image); !p.done(); ++p)
        for (int c = 0; c < image.nchannels(); ++c)
            p[c] = pixel[size_t(c)];
    return image;
}

inline ImageBuf constant(int width, int height, const std::vector<float>& rgb) {
    return constant(make_spec(width, height, {"R", "G", "B"}), rgb);
}

/// Every value times a random factor within 1 +- amount / 2.
inline ImageBuf disturbed(const ImageBuf& image, double amount, uint32_t seed) {
    ImageBuf out = image;
    std::mt19937 random(seed);
    for (ImageBuf::Iterator<float> p(out); !p.done(); ++p)
        for (int c = 0; c < out.nchannels(); ++c)
            p[c] = float(double(p[c]) * (1 + amount * (double(random()) / 4294967296.0 - 0.5)));
    return out;
}

inline ImageBuf scaled(const ImageBuf& image, double factor) {
    ImageBuf out = image;
    for (ImageBuf::Iterator<float> p(out); !p.done(); ++p)
        for (int c = 0; c < out.nchannels(); ++c)
            p[c] = float(double(p[c]) * factor);
    return out;
}

inline ImageBuf with_pixel(const ImageBuf& image, int x, int y, const std::vector<float>& pixel) {
    ImageBuf out = image;
    out.setpixel(x, y, pixel.data());
    return out;
}

inline std::vector<float> pixel_of(const ImageBuf& image, int x, int y) {
    std::vector<float> out(size_t(image.nchannels()));
    image.getpixel(x, y, out.data());
    return out;
}

/// All values, pixel by pixel.
inline std::vector<float> values(const ImageBuf& image) {
    std::vector<float> out(size_t(image.spec().image_pixels()) * size_t(image.nchannels()));
    if (image.initialized()) // OpenImageIO 2.5 ends the program else
        image.get_pixels(image.roi(), OIIO::TypeFloat, out.data());
    return out;
}

inline double largest_difference(const ImageBuf& a, const ImageBuf& b) {
    const auto p = values(a), q = values(b);
    double out = p.size() == q.size() ? 0 : INFINITY;
    for (size_t i = 0; i < std::min(p.size(), q.size()); ++i)
        out = std::max(out, std::abs(double(p[i]) - double(q[i])));
    return out;
}

} // namespace tonetool
