// SPDX-License-Identifier: BSD-3-Clause
// The fields of BiasOptions and NoiseFloorOptions that are numbers, names or lists.
#pragma once

#include "imagebuf/options/option.h"
#include "tonetool/bias.h"

namespace tonetool {

template <class See>
void describe(const BiasOptions&, See&& see) {
    using O = BiasOptions;
    const auto names = [](const auto& list) {
        return std::vector<std::string>(std::begin(list), std::end(list));
    };
    see(option("within", &O::within,
               "margin of the claim \"equal\", as a part of the light: 0.05 is 5 %")
            .within(1e-6, 0.9999));
    see(option("alpha", &O::alpha,
               "false alarms per image of \"different\", and level of each claim in \"equal\"")
            .within(1e-12, 0.49));
    see(option("power", &O::power, "chance to show equality that \"N times more samples\" aims at")
            .within(0.5, 0.9999));
    see(option("reference", &O::reference,
               "noise of the reference: judged from the images, like the test's by contract (same "
               "sampler and samples per pixel), or converged")
            .one_of(names(kBiasNoises)));
    see(option("halves", &O::halves,
               "layers with independent halves of the samples: each file counts as two seeds")
            .shown_as("A,B")
            .unset("none"));
    see(option("map", &O::map, "which map: signed difference, log10 p, what differs, or all")
            .one_of(names(kBiasMaps)));
}

template <class See>
void describe(const NoiseFloorOptions&, See&& see) {
    using O = NoiseFloorOptions;
    see(option("content", &O::content, "part of future unbiased renders that lies below the limit")
            .within(0.5, 0.99999));
    see(option("confidence", &O::confidence, "confidence that it is at least this part")
            .within(0.5, 0.99999));
}

} // namespace tonetool
