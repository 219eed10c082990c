// SPDX-License-Identifier: BSD-3-Clause
// The fields of AttributeOptions that it has beside those of HdrFlipOptions.
#pragma once

#include "imagebuf/options/flip_options.h"
#include "tonetool/attribute.h"

namespace tonetool {

template <class See>
void describe(const AttributeOptions&, See&& see) {
    using O = AttributeOptions;
    std::vector<std::string> metrics = {"hdrflip", "ldrflip"};
    for (const std::string& name : ToneAlgo::error_metrics())
        metrics.push_back(name);
    see(option("metric", &O::metric, "whose error is attributed").one_of(metrics));
    see(option("eps", &O::eps,
               "epsilon of " + OIIO::Strutil::join(metrics_that_have(metrics::kEps), ", "))
            .within(1e-12, 1e12));
    see(option("alone", &O::alone,
               "also what each light group does alone; else only what replacing it takes away"));
}

} // namespace tonetool
