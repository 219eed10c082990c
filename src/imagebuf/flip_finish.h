// From the planes of a comparison to its map, summary and pictures.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <vector>

#include "imagebuf/flip_plan.h"

namespace tonetool {

/// Results of one test over the pixels asked for, without padding.
struct FlipMaps {
    std::vector<float> error, index;
    std::vector<std::vector<float>> per_exposure;

    FlipMaps(const FlipPlan& plan, size_t pixels, size_t exposures);
    flip::Output output(int width);
};

/// One comparison after the algorithm has run.
struct Compared {
    const FlipPlan& plan;
    const Exposures& exposures;
    const ColorPlanes& reference;
    const ColorPlanes& test;
    OIIO::ROI roi;  ///< pixels of the maps, within the region of the planes
    OIIO::ROI full; ///< display window of the map
    int64_t nonfinite_both = 0;
    std::vector<std::string> notes; ///< more warnings
    int nthreads = 0;
};

/// Lets non-finite pixels and alpha enter the map, pools it, and fills `result` and `map`.
void finish(const Compared& compared, FlipMaps& planes, OIIO::ImageBuf& map, FlipResult& result);

} // namespace tonetool
