// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "kernels/noise_rows.h"

namespace tonetool::kernels {
namespace {

double squared_step(const float* const (&planes)[3], ptrdiff_t i, ptrdiff_t j) {
    double sum = 0;
    for (const float* plane : planes)
        if (plane)
            sum += (double(plane[i]) - double(plane[j])) * (double(plane[i]) - double(plane[j]));
    return sum;
}

bool is_background(const GuidePlanes& image, ptrdiff_t i) {
    return image.background && image.background[i] != 0;
}

} // namespace

NoiseShare noise_reference(const GuidePlanes& image, int x, int y) {
    const auto place = [&](int px, int py) {
        return (std::clamp(py, 0, image.height - 1) - image.first_row) * image.stride +
               std::clamp(px, 0, image.width - 1);
    };
    const ptrdiff_t here = place(x, y);
    double exponent = 0, sum = 0;
    bool one_kind = true;
    for (const ptrdiff_t i : {place(x - 1, y), place(x + 1, y), place(x, y - 1), place(x, y + 1)}) {
        sum += double(image.value[i]);
        exponent += squared_step(image.normal, here, i) / (2 * kFlatNormal * kFlatNormal) +
                    squared_step(image.albedo, here, i) / (2 * kFlatAlbedo * kFlatAlbedo);
        one_kind = one_kind && is_background(image, here) == is_background(image, i);
    }
    const double h = double(image.value[here]) - sum / 4;
    if (!one_kind || !std::isfinite(h))
        return {0, 0};
    const double flat = std::exp(-exponent - std::pow(h / kFlatStep, 4));
    return {flat, flat * h * h};
}

} // namespace tonetool::kernels
