// What view_light.cpp and view_bake.cpp share.
#pragma once

#include <OpenColorIO/OpenColorIO.h>
#include <string>

#include "imagebuf/view.h"

namespace tonetool {

struct DisplayLight::State {
    std::string name;
    OCIO_NAMESPACE::ConstCPUProcessorRcPtr processor; // linear Rec.709 scene to display light

    // Packed RGB in place, nothing clamped.
    void light(float* rgb, ptrdiff_t count) const;
};

} // namespace tonetool
