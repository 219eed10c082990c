// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/luminance_means.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/luminance_sums.h"

namespace tonetool::tonemap {

LuminanceMeans luminance_means(const float* plane, int width, int height, double epsilon,
                               const kernels::ParallelFor& parallel) {
    std::vector<kernels::LuminanceSums> rows(size_t(std::max(height, 0)));
    parallel(height, [&](int64_t y) {
        rows[size_t(y)] = kernels::luminance_sums(plane + y * width, width, float(epsilon));
    });
    kernels::LuminanceSums all;
    for (const kernels::LuminanceSums& row : rows) {
        all.counted += row.counted;
        all.values += row.values;
        all.logs += row.logs;
        all.reciprocals += row.reciprocals;
        all.most = std::max(all.most, row.most);
    }
    if (all.counted == 0)
        return {};
    const auto n = double(all.counted);
    return {all.counted, double(all.most), all.values / n, std::exp(all.logs / n),
            n / all.reciprocals};
}

} // namespace tonetool::tonemap
