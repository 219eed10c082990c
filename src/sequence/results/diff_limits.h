// SPDX-License-Identifier: BSD-3-Clause
// What --diff lets pass, and the options that say so.
#pragma once

namespace tonetool::sequence {

/// How far two images may differ before that fails, or warns.
struct DiffLimit {
    float each = 1e-6f;    ///< a pixel whose difference is above it counts
    float percent = 0;     ///< so many of the pixels may count
    float hardest = 1e30f; ///< no pixel's difference may be above it

    /// Pixels that may count.
    double allowed(double pixels) const { return double(percent) / 100 * pixels; }
};

struct DiffLimits {
    DiffLimit fail, warn;
};

struct DiffOption {
    const char *name, *argument, *help;
    DiffLimit DiffLimits::*limit;
    float DiffLimit::*number;
};

inline constexpr DiffOption kDiffOptions[] = {
    {"fail", "THRESH", "--diff: a pixel fails above it (1e-6)", &DiffLimits::fail,
     &DiffLimit::each},
    {"failpercent", "PCNT", "--diff: so many failing pixels are allowed (0)", &DiffLimits::fail,
     &DiffLimit::percent},
    {"hardfail", "THRESH", "--diff: no pixel may exceed it (infinity)", &DiffLimits::fail,
     &DiffLimit::hardest},
    {"warn", "THRESH", "--diff: a pixel warns above it (1e-6)", &DiffLimits::warn,
     &DiffLimit::each},
    {"warnpercent", "PCNT", "--diff: so many warning pixels are allowed (0)", &DiffLimits::warn,
     &DiffLimit::percent},
    {"hardwarn", "THRESH", "--diff: a pixel above it is a warning (infinity)", &DiffLimits::warn,
     &DiffLimit::hardest}};

} // namespace tonetool::sequence
