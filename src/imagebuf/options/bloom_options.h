// SPDX-License-Identifier: BSD-3-Clause
// The fields of BloomOptions, but for the pixels.
#pragma once

#include "imagebuf/options/option.h"
#include "tonetool/bloom.h"

namespace tonetool {

template <class See>
void describe(const BloomOptions&, See&& see) {
    using O = BloomOptions;
    see(option("threshold", &O::threshold,
               "luminance above which light spreads; 6s: so many stops above the mean of cells")
            .shown_as("X|Ns"));
    see(option("amount", &O::amount, "share of that light which spreads").within(0, 1));
    see(option("psf", &O::psf, "how light spreads; spencer: in the eye, gaussian: in a lens")
            .one_of({"spencer", "gaussian"}));
    see(option("vision", &O::vision,
               "what the eye of psf=spencer is adapted to: day, dusk or night")
            .one_of({"photopic", "mesopic", "scotopic"}));
    see(option("fov", &O::fov, "horizontal field of view in degrees, for psf=spencer")
            .within(1, 179)
            .in("degrees")
            .shown_as("DEGREES")
            .unset("the image's camera, or 40"));
    see(option("radius", &O::radius, "sigma of the widest Gaussian of psf=gaussian in pixels")
            .within(1e-3, 10000)
            .in("pixels")
            .unset("3 % of the width"));
}

} // namespace tonetool
