// SPDX-License-Identifier: BSD-3-Clause
// A threshold from the values that renders of the approved version have, with its rate of false
// alarms.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace tonetool::metrics {

enum class NoiseFloorMethod {
    OrderStatistic, ///< one of the values; nothing is assumed of their distribution
    Lognormal,      ///< exp(mean + k sd) of the logarithms
    Normal          ///< mean + k sd, where a value is 0 or less
};

struct NoiseFloorOptions {
    double content = 0.99;    ///< the part of future unbiased renders that must lie below
    double confidence = 0.95; ///< that it is at least this part
    bool below_one = false;   ///< the quantity is never above 1: a limit of 1 could not be exceeded
};

struct NoiseFloor {
    double limit = 0;
    NoiseFloorMethod method = NoiseFloorMethod::Lognormal;
    int64_t values = 0, needed = 0; ///< from `needed` values on the method is OrderStatistic
    int64_t rank = 0;               ///< OrderStatistic: which of the ascending values, from 1
    double k = 0;                   ///< the others: the tolerance factor
    std::optional<size_t> outlier;  ///< the largest value, where the others make it implausible
};

/// The smallest upper tolerance limit: with `confidence`, at least the part `content` of the
/// distribution that `values` are from lies below it (Hahn and Meeker, "Statistical Intervals",
/// 1991). Fewer than 4 values, values that are not finite, and a limit that cannot be exceeded are
/// refused.
NoiseFloor noise_floor(const std::vector<double>& values, const NoiseFloorOptions& options);

} // namespace tonetool::metrics
