// SPDX-License-Identifier: BSD-3-Clause
// The fields of IgnoreOptions, and how its summaries show what they did.
#pragma once

#include "imagebuf/options/option.h"
#include "imagebuf/options/summary_fields.h"
#include "tonetool/compare.h"

namespace tonetool {

template <class See>
void describe(const IgnoreOptions&, See&& see) {
    using O = IgnoreOptions;
    see(option(
            "mask", &O::mask,
            "image of the reference's size whose first channel is 0.5 or more where pixels count")
            .shown_as("FILE")
            .unset("all count"));
    see(option("ignore", &O::ignore, "regions that do not count, in the reference's pixels")
            .shown_as("WxH+X+Y,...")
            .unset("none"));
}

/// Of any summary; `visit` is called only where a mask or a region was given.
template <class S, class Visit>
void visit_ignored(const S& summary, const Visit& visit) {
    if (summary.ignored)
        visit(kIgnoredField, *summary.ignored);
}

} // namespace tonetool
