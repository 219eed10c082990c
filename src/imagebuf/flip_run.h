// Comparisons of ImageBufs: read, run, finish.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "imagebuf/flip_plan.h"

namespace tonetool {

/// Compares the tests with the reference; `maps` and `results` get one element per test, in order.
/// False with a reason: they are not to be used.
bool run_flip(const FlipPlan& plan, const OIIO::ImageBuf& reference,
              const std::vector<const OIIO::ImageBuf*>& tests, OIIO::ROI roi, int nthreads,
              std::vector<OIIO::ImageBuf>& maps, std::vector<FlipResult>& results,
              std::string& error);

} // namespace tonetool
