// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/tone/noise.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/pixels/parallel.h"
#include "metrics/order_statistics.h"
#include "metrics/refusal.h"
#include "tonemap/noise.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::Strutil::fmt::format;

constexpr float kMostNoise = 1;

// The mean of the two in the middle of an even number.
float median(const PagedArray<float>& plane, int width, int height,
             const kernels::ParallelFor& parallel) {
    const metrics::OrderStatistics order(plane.data(), width, height, width, parallel);
    if (order.count() == 0)
        return 0;
    const auto middle = order.find(
        {metrics::Wanted::rank((order.count() - 1) / 2), metrics::Wanted::rank(order.count() / 2)});
    return 0.5f * (middle[0] + middle[1]);
}

// A channel, or the only one of a layer.
int channel_of(const ImageSpec& spec, const std::string& layer) {
    if (const int found = spec.channelindex(layer); found >= 0)
        return found;
    int found = -1;
    for (int c = 0; c < spec.nchannels; ++c) {
        if (!OIIO::Strutil::starts_with(spec.channel_name(c), layer + "."))
            continue;
        if (found >= 0)
            throw Refusal(format("noise layer \"{}\" has more than one channel: name one", layer));
        found = c;
    }
    if (found < 0)
        throw Refusal(format("there is no layer \"{}\" (noise=); channels: {}", layer,
                             OIIO::Strutil::join(spec.channelnames, ", ")));
    return found;
}

} // namespace

PagedArray<float> measured_noise(const kernels::GuidePlanes& image,
                                 const kernels::ParallelFor& parallel) {
    PagedArray<float> noise;
    const auto width = size_t(image.width);
    noise.resize(width * size_t(image.height));
    noise.expect_all_written();
    tonemap::noise_plane(image, noise.data(), parallel);
    const float usual = median(noise, image.width, image.height, parallel);
    parallel(image.height, [&](int64_t y) {
        float* const row = noise.data() + size_t(y) * width;
        std::replace_if(
            row, row + width, [](float v) { return std::isnan(v); }, usual);
    });
    return noise;
}

PagedArray<float> noise_of_layer(const ImageBuf& image, const std::string& layer, OIIO::ROI region,
                                 const float* logarithms, int nthreads) {
    region.chbegin = channel_of(image.spec(), layer);
    region.chend = region.chbegin + 1;
    PagedArray<float> noise;
    const auto width = size_t(region.width());
    noise.resize(width * size_t(region.height()));
    if (!image.get_pixels(region, OIIO::TypeFloat, noise.data()))
        throw Refusal(format("layer \"{}\" cannot be read: {}", layer, image.geterror()));
    make_parallel(nthreads)(region.height(), [&](int64_t y) {
        for (size_t i = size_t(y) * width; i < size_t(y + 1) * width; ++i) {
            const double share = double(noise[i]) * std::exp(-2 * double(logarithms[i]));
            noise[i] = share > 0 ? float(std::min(share, double(kMostNoise))) : 0;
        }
    });
    return noise;
}

} // namespace tonetool
