// SPDX-License-Identifier: BSD-3-Clause
// ToneAlgo::panorama_stats.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/parallel.h"
#include "metrics/refusal.h"
#include "tonetool/lights.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

constexpr double kEpsilon = 1e-6;

// What a texel of each row counts. The part of a sphere between two polar angles has the area
// 2 pi (cos a - cos b), of which the texels of a row share alike.
std::vector<double> row_weights(int height, bool solid_angle) {
    std::vector<double> weights(size_t(height), 1.0);
    for (int j = 0; solid_angle && j < height; ++j)
        weights[size_t(j)] = std::cos(M_PI * j / height) - std::cos(M_PI * (j + 1) / height);
    return weights;
}

struct Sums {
    int64_t count = 0;
    double weight = 0, log = 0, inverse = 0, value = 0, max = 0;

    void add(double l, double w) {
        ++count;
        weight += w;
        log += w * std::log(l + kEpsilon);
        inverse += w / (l + kEpsilon);
        value += w * l;
        max = std::max(max, l);
    }
    void add(const Sums& o) {
        count += o.count;
        weight += o.weight;
        log += o.log;
        inverse += o.inverse;
        value += o.value;
        max = std::max(max, o.max);
    }
};

// The smallest luminance with more than half of the weight at or below it.
double weighted_median(const PagedArray<float>& luminance, const ROI& region,
                       const double* weights) {
    std::vector<std::pair<float, double>> texels;
    const auto width = size_t(region.width());
    double all = 0;
    for (size_t i = 0; i < width * size_t(region.height()); ++i)
        if (const float l = luminance[i]; std::isfinite(l)) {
            texels.emplace_back(l, weights[i / width]);
            all += weights[i / width];
        }
    std::sort(texels.begin(), texels.end());
    double below = 0;
    for (const auto& [l, weight] : texels)
        if ((below += weight) > all / 2)
            return l;
    return texels.empty() ? 0 : texels.back().first;
}

void check_shape(const OIIO::ImageSpec& spec, const std::string& weight) {
    check_one_of("weight", weight, {"solidangle", "none"});
    if (weight != "none" && int64_t(spec.full_width) != 2 * int64_t(spec.full_height))
        throw Refusal(
            format("{} x {} pixels: a latitude-longitude panorama is twice as wide as high "
                   "(weight=none takes any picture, each pixel alike)",
                   spec.full_width, spec.full_height));
}

// Row by row, in their order.
Sums add_up(const PagedArray<float>& luminance, const ROI& region, const double* weights,
            int nthreads) {
    std::vector<Sums> rows(size_t(region.height()));
    make_parallel(nthreads)(region.height(), [&](int64_t y) {
        const float* row = luminance.data() + size_t(y) * size_t(region.width());
        for (int x = 0; x < region.width(); ++x)
            if (std::isfinite(row[x]))
                rows[size_t(y)].add(row[x], weights[y]);
    });
    Sums sums;
    for (const Sums& row : rows)
        sums.add(row);
    return sums;
}

void measure(PanoramaStats& stats, const ImageBuf& src, const PanoramaOptions& options,
             int nthreads) {
    check_readable(src, "panorama");
    check_shape(src.spec(), options.weight);
    const ROI full = src.roi_full(), region = OIIO::roi_intersection(src.roi(), full);
    if (region.width() <= 0 || region.height() <= 0)
        throw Refusal("its data window is outside its display window");
    ColorReader reader;
    reader.open(src, options.pixels, region, false, nthreads);
    ColorPlanes planes = reader.planes();
    const auto luminance = read_luminance(reader, planes, nthreads);
    const std::vector<double> all = row_weights(full.height(), options.weight == "solidangle");
    const double* weights = all.data() + (region.ybegin - full.ybegin);
    const Sums sums = add_up(luminance, region, weights, nthreads);
    if (sums.count == 0)
        throw Refusal("the panorama has no finite pixel");
    stats = {};
    stats.pixels = int64_t(full.width()) * full.height();
    stats.uncovered = stats.pixels - int64_t(region.width()) * region.height();
    stats.nonfinite = planes.counts.nonfinite;
    stats.negative = planes.counts.negative;
    stats.geometric = std::exp(sums.log / sums.weight);
    stats.harmonic = sums.weight / sums.inverse;
    stats.mean = sums.value / sums.weight;
    stats.median = weighted_median(luminance, region, weights);
    stats.max = sums.max;
    stats.layer = planes.choice.layer;
    stats.space = planes.choice.space;
}

} // namespace

bool ToneAlgo::panorama_stats(PanoramaStats& stats, const ImageBuf& src, std::string& error,
                              const PanoramaOptions& options, int nthreads) {
    return contained(error, [&] { measure(stats, src, options, nthreads); });
}

} // namespace tonetool
