// SPDX-License-Identifier: BSD-3-Clause
// The fields of CameraOptions.
#pragma once

#include "imagebuf/options/option.h"
#include "tonetool/camera_numbers.h"

namespace tonetool {

template <class See>
void describe(const CameraOptions&, See&& see) {
    using O = CameraOptions;
    see(option("fnumber", &O::fnumber, "f-number of method=camera")
            .positive()
            .unset("the header's aperture"));
    see(option("shutter", &O::shutter, "time of exposure of method=camera in seconds")
            .positive()
            .in("s")
            .unset("the header's expTime"));
    see(option("iso", &O::iso, "ISO speed of method=camera")
            .positive()
            .unset("the header's isoSpeed"));
}

} // namespace tonetool
