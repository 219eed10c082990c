// SPDX-License-Identifier: BSD-3-Clause
// What the curve of CG-TMO follows from: the adaptation luminance and the largest one, from the
// image, its lights and a panorama of the scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imagebuf/color/color_reader.h"
#include "imagebuf/pixels/paged_array.h"
#include "tonetool/cgtmo.h"

namespace tonetool {

struct SceneStats {
    double adaptation = 0, maximum = 0;
    std::string adaptation_from, maximum_from, maximum_light, light_index;
    int64_t counted = 0; ///< pixels whose light was measured
    std::string adapted; ///< of which frames the shot is that stands for the image; empty: of none
    double unit = 0;     ///< with a camera
    std::optional<double> ev100; ///< of the camera
    std::vector<std::string> warnings, notes;
    PagedArray<float> luminance; ///< packed; NaN where the colour was not finite
};

/// `planes` hold the colour of the whole image, as `reader` reads it, and alpha where the options
/// need it; `background` is 1 where the image shows no surface, null where nothing tells.
SceneStats measure_scene(const OIIO::ImageBuf& image, const CgTmoOptions& options,
                         ColorReader& reader, ColorPlanes& planes, const uint8_t* background,
                         int nthreads);

} // namespace tonetool
