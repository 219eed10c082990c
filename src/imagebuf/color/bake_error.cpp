// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/bake_error.h"

#include <algorithm>
#include <cmath>

namespace tonetool {
namespace {

constexpr int64_t kSamples = 1 << 16, kFewestPixels = 64;

struct Samples {
    std::vector<float> plane[3];
    explicit Samples(size_t count) {
        for (auto& p : plane)
            p.resize(count);
    }
    size_t count() const { return plane[0].size(); }
    void run(const kernels::ToneRows& rows, const Samples& in, float scale) {
        const float* const from[3] = {in.plane[0].data(), in.plane[1].data(), in.plane[2].data()};
        float* const to[3] = {plane[0].data(), plane[1].data(), plane[2].data()};
        rows(from, to, ptrdiff_t(count()), scale);
    }
};

// Pixels number 0, step, 2 step, ... of the region. The step is odd, so that it does not stay in
// the columns of a power of two.
Samples sample(const ColorPlanes& planes, int begin, int end, size_t exposures) {
    const int64_t width = planes.width();
    const int64_t wanted = std::max(kSamples / int64_t(exposures), kFewestPixels);
    const int64_t step = ((width * planes.region.height() + wanted - 1) / wanted) | 1;
    const int64_t first = (begin - planes.region.ybegin) * width;
    const int64_t last = (end - planes.region.ybegin) * width;
    Samples samples(0);
    for (int64_t i = (first + step - 1) / step * step; i < last; i += step) {
        const size_t at = size_t(i - first) + planes.at(begin);
        for (int c = 0; c < 3; ++c)
            samples.plane[c].push_back(planes.plane[c].data()[at]);
    }
    return samples;
}

} // namespace

void BakeError::add(const BakeError& other) {
    max = std::max(max, other.max);
    sum += other.sum;
    samples += other.samples;
}

BakeError measure_bake(const DisplayLight& light, const ColorPlanes& planes, int begin, int end,
                       const std::vector<double>& stops) {
    const Samples samples = sample(planes, begin, end, stops.size());
    const auto exact = light.exact(), baked = light.baked();
    Samples truth(samples.count()), table(samples.count());
    BakeError error;
    for (double stop : stops) {
        truth.run(exact, samples, float(std::exp2(stop)));
        table.run(baked, samples, float(std::exp2(stop)));
        for (int c = 0; c < 3; ++c)
            for (size_t i = 0; i < samples.count(); ++i) {
                const double off = std::abs(double(truth.plane[c][i]) - double(table.plane[c][i]));
                error.max = std::max(error.max, off);
                error.sum += off;
            }
    }
    error.samples = int64_t(3 * samples.count() * stops.size());
    return error;
}

} // namespace tonetool
