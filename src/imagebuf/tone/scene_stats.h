// SPDX-License-Identifier: BSD-3-Clause
// What the curve of CG-TMO follows from: the adaptation luminance and the largest one, from the
// image, its lights and a panorama of the scene.
#pragma once

#include <string>
#include <vector>

#include "imagebuf/color/color_reader.h"
#include "imagebuf/pixels/paged_array.h"
#include "tonetool/cgtmo.h"

namespace tonetool {

struct SceneStats {
    double adaptation = 0, maximum = 0;
    std::string adaptation_from, maximum_from, maximum_light, light_index;
    std::vector<std::string> warnings;
    PagedArray<float> luminance; ///< packed; NaN where the colour was not finite
};

/// `planes` hold the colour of the whole image, as `reader` reads it.
SceneStats measure_scene(const OIIO::ImageBuf& image, const CgTmoOptions& options,
                         ColorReader& reader, ColorPlanes& planes, int nthreads);

} // namespace tonetool
