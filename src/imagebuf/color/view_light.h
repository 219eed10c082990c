// SPDX-License-Identifier: BSD-3-Clause
// What view_light.cpp and view_bake.cpp share.
#pragma once

#include <OpenColorIO/OpenColorIO.h>
#include <memory>
#include <mutex>
#include <string>

#include "imagebuf/color/view.h"
#include "kernels/lut_rows.h"

namespace tonetool {

struct DisplayLight::State {
    std::string name;
    OCIO_NAMESPACE::ConstCPUProcessorRcPtr processor; // linear Rec.709 scene to display light

    mutable std::once_flag baking;
    mutable std::unique_ptr<kernels::LightCube> baked;

    // Packed RGB in place, nothing clamped.
    void light(float* rgb, ptrdiff_t count) const;
};

/// The source's light at the vertices, on two threads.
std::unique_ptr<kernels::LightCube> bake(const LightSource& source,
                                         const kernels::CubeShape& shape);

} // namespace tonetool
