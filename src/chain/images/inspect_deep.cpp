// SPDX-License-Identifier: BSD-3-Clause
// Prints information about deep images.
#include <OpenImageIO/strutil.h>
#include <cmath>
#include <limits>

#include "chain/images/inspect.h"
#include "text/text.h"

namespace tonetool::chain {

namespace {

using OIIO::Strutil::fmt::format;

struct Depth {
    float value;
    int x = 0, y = 0;
};

// Numbers of samples of the pixels, and the pixels with the least and the greatest depth.
struct Samples {
    std::vector<size_t> pixels_with;
    size_t total = 0;
    int x_of_most = 0, y_of_most = 0;
    Depth nearest{std::numeric_limits<float>::max()};
    Depth farthest{-std::numeric_limits<float>::max()};

    void add(const OIIO::ImageBuf& image, int x, int y) {
        const size_t count = size_t(image.deep_samples(x, y, 0));
        if (count >= pixels_with.size()) {
            pixels_with.resize(count + 1);
            x_of_most = x;
            y_of_most = y;
        }
        ++pixels_with[count];
        total += count;
        const int z = image.spec().channelindex("Z");
        for (int s = 0; z >= 0 && s < int(count); ++s) {
            const float depth = image.deep_value(x, y, 0, z, s);
            nearest = depth < nearest.value ? Depth{depth, x, y} : nearest;
            farthest = depth > farthest.value ? Depth{depth, x, y} : farthest;
        }
    }
};

// The histogram of sample counts: one bin for each count below 8, then bins up to the next power of
// two.
std::string histogram(const std::vector<size_t>& pixels_with, size_t pixels) {
    std::string text;
    size_t first = 0, sum = 0;
    for (size_t i = 0; i < pixels_with.size(); ++i) {
        sum += pixels_with[i];
        if (i < 8 || i + 1 == pixels_with.size() || OIIO::ispow2(i + 1)) {
            text += first == i ? format("  {:3}    ", i) : format("  {:3}-{:3}", first, i);
            text += format(" : {:8} ({:4.1f}%)\n", sum, 100.0 * double(sum) / double(pixels));
            first = i + 1;
            sum = 0;
        }
    }
    return text;
}

} // namespace

std::string deep_stats_text(const OIIO::ImageBuf& image, const std::string& indent) {
    Samples found;
    for (int y = image.ybegin(); y < image.yend(); ++y)
        for (int x = image.xbegin(); x < image.xend(); ++x)
            found.add(image, x, y);
    const std::vector<size_t>& pixels_with = found.pixels_with;
    const size_t pixels = image.spec().image_pixels(), most = pixels_with.size() - 1;
    size_t least = 0;
    while (pixels_with[least] == 0)
        ++least;
    const size_t without = pixels_with.front();
    std::string text = format("Min deep samples in any pixel : {}\n"
                              "Max deep samples in any pixel : {}\n",
                              least, most);
    text +=
        format("{} pixel{} had the max of {} samples, including (x={}, y={})\n", pixels_with[most],
               pixels_with[most] > 1 ? "s" : "", most, found.x_of_most, found.y_of_most);
    text += format("Average deep samples per pixel: {:.2f}\n"
                   "Total deep samples in all pixels: {}\nPixels with deep samples   : {}\n"
                   "Pixels with no deep samples: {}\nSamples/pixel histogram:\n",
                   double(found.total) / double(pixels), found.total, pixels - without, without);
    text += histogram(pixels_with, pixels);
    for (const auto& [name, depth] :
         {std::pair("Minimum", found.nearest), std::pair("Maximum", found.farthest)}) {
        text += found.nearest.value <= found.farthest.value
                    ? format("{} depth was {:g} at ({}, {})\n", name, depth.value, depth.x, depth.y)
                    : "";
    }
    std::string lines;
    for (const std::string& line : OIIO::Strutil::splits(OIIO::Strutil::rstrip(text), "\n"))
        lines += indent + line + "\n";
    return lines;
}

std::string deep_dump_text(const OIIO::ImageBuf& image, bool empty_ones) {
    std::string text;
    const OIIO::ImageSpec& spec = image.spec();
    for (OIIO::ImageBuf::ConstIterator<float> pixel(image); !pixel.done(); ++pixel) {
        const int count = pixel.deep_samples();
        if (count == 0 && !empty_ones)
            continue;
        Strings samples;
        for (int s = 0; s < count; ++s) {
            Strings values;
            for (int c = 0; c < spec.nchannels; ++c)
                values.push_back(format("{}={}", spec.channel_name(c), pixel.deep_value(c, s)));
            samples.push_back(" " + join(values, " "));
        }
        text += format("    Pixel ({}, {}): {} samples {}{}\n", pixel.x(), pixel.y(), count,
                       count > 0 ? ":" : "", join(samples, " / "));
    }
    return text;
}

} // namespace tonetool::chain
