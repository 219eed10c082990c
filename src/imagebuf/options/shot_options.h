// SPDX-License-Identifier: BSD-3-Clause
// The fields of AdaptOptions but for the statistics themselves.
#pragma once

#include "imagebuf/options/option.h"
#include "tonetool/shot_numbers.h"

namespace tonetool {

template <class See>
void describe(const AdaptOptions&, See&& see) {
    using O = AdaptOptions;
    see(option("adapt", &O::adapt,
               "what the exposure follows from; frame: each image by itself, shot: one for all "
               "frames, eye: as eyes adapt, smooth: a mean over time, or statistics that "
               "--statistics wrote")
            .shown_as("frame|shot|eye|smooth|FILE"));
    see(option("frame", &O::frame, "number of the image in the FILE of adapt=")
            .shown_as("N")
            .unset("the frame's"));
    see(option("mode", &O::mode, "how the exposure follows the FILE of adapt=")
            .one_of({"shot", "eye", "smooth"})
            .unset("that of the file"));
    see(option("tau", &O::tau, "seconds that adapt=eye or smooth takes")
            .within(1e-3, 1e4)
            .in("s")
            .unset("smooth 0.4, eye 0.4 in the dark to 0.1"));
    see(option("fps", &O::fps, "frames per second, for adapt=eye and smooth")
            .within(1e-3, 1e5)
            .unset("the header's, or 24"));
    see(option(
            "unit", &O::unit,
            "cd/m2 of a pixel value of 1, for method=auto and camera and for adapt=eye; 179 where "
            "1 is 1 W/(m2 sr) of white light")
            .positive()
            .unset("the header's whiteLuminance, or 1"));
    see(option("cuts", &O::cuts,
               "first frames of scenes, none, or auto: found where neighbours are not alike")
            .shown_as("auto|none|N,..."));
    see(option("adaptspace", "space", &O::space,
               "what adapt= averages: logarithms of luminance or "
               "luminance")
            .one_of({"log", "linear"}));
}

} // namespace tonetool
