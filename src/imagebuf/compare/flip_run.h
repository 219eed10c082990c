// SPDX-License-Identifier: BSD-3-Clause
// Comparisons of ImageBufs: read, run, finish.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "imagebuf/compare/flip_plan.h"

namespace tonetool {

/// Compares the tests with the reference; `maps` and `results` get one element per test, in order.
/// A map is computed in the pixels of its `dst` where these can take it. After a Refusal none of
/// them is to be used.
void run_flip(const FlipPlan& plan, const OIIO::ImageBuf& reference,
              const std::vector<const OIIO::ImageBuf*>& tests,
              const std::vector<OIIO::ImageBuf*>& dst, OIIO::ROI roi, int nthreads,
              std::vector<OIIO::ImageBuf>& maps, std::vector<FlipResult>& results);

} // namespace tonetool
