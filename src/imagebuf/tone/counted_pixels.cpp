// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/tone/counted_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "imagebuf/aov/gbuffer.h"
#include "tonemap/cell_mean.h"

namespace tonetool {
namespace {

constexpr float kNoPixel = std::numeric_limits<float>::quiet_NaN();

float counted(float luminance, const ShownPixels& shown, size_t i) {
    if (!std::isfinite(luminance) || (shown.alpha && !(shown.alpha[i] > 0)))
        return kNoPixel;
    if (luminance > 0)
        return luminance;
    if (shown.background)
        return shown.background[i] ? kNoPixel : tonemap::kBlackSurface;
    return shown.alpha ? tonemap::kBlackSurface : tonemap::kBlackAnywhere;
}

CountedPixels count(const float* luminance, int width, int height, const ShownPixels& shown,
                    const kernels::ParallelFor& parallel) {
    CountedPixels out;
    out.luminance.resize(size_t(width) * size_t(height));
    out.luminance.expect_all_written();
    std::vector<std::pair<int64_t, int64_t>> rows(static_cast<size_t>(height));
    parallel(height, [&](int64_t y) {
        auto& [lit, nothing] = rows[size_t(y)];
        for (size_t i = size_t(y) * size_t(width); i < size_t(y + 1) * size_t(width); ++i) {
            const float v = out.luminance[i] = counted(luminance[i], shown, i);
            lit += v > 0;
            nothing += !(v >= tonemap::kBlackSurface);
        }
    });
    for (const auto& [lit, nothing] : rows) {
        out.lit += lit;
        out.nothing += nothing;
    }
    return out;
}

} // namespace

CountedPixels counted_pixels(const float* luminance, int width, int height,
                             const ShownPixels& shown, const kernels::ParallelFor& parallel) {
    CountedPixels out = count(luminance, width, height, shown, parallel);
    if (out.lit > 0 || !shown.alpha)
        return out;
    out = count(luminance, width, height, {nullptr, shown.background}, parallel);
    out.alpha_tells = out.lit == 0;
    return out;
}

metrics::Wanted maximum_of_lit(double percentile, int64_t counted) {
    constexpr double rounding = 1e-6; // a little less than a pixel is none
    const double above = (100 - percentile) / 100 * double(counted);
    const auto passed = std::max<int64_t>(1, int64_t(std::ceil(above - rounding)));
    return metrics::Wanted::rank(counted - 1 - passed);
}

std::vector<uint8_t> background_of(const OIIO::ImageBuf& image, const std::string& layer,
                                   OIIO::ROI region, int nthreads) {
    const GBufferNames names = find_gbuffer(image.spec(), {"", "none", "none", "", layer});
    if (!names.any())
        return {};
    return read_gbuffer(image, names, region, nthreads).background;
}

} // namespace tonetool
