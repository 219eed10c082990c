// SPDX-License-Identifier: BSD-3-Clause
// What the FLIP functions return.
#pragma once

#include <utility>
#include <vector>

#include "python/compare.h"
#include "tonetool/flip.h"

namespace tonetool::python {

struct ExposureObject {
    double stops = 0;
    py::object reference, test, flip;
};
struct FlipObject : Imaged<FlipSummary> {
    py::object exposure_stops, exposure_index;
    std::vector<ExposureObject> exposures;
};
struct FilmstripObject : Imaged<FlipSummary> {};

/// Maps become what the reference is.
py::object flip_object(OIIO::ImageBuf&& map, FlipResult&& result, const InputImage& reference);

} // namespace tonetool::python
