// SPDX-License-Identifier: BSD-3-Clause
// Small pictures of the layers of a frame in which a fault was found: what a viewer of the beauty
// alone never sees.
#pragma once

#include <string>

#include "sequence/results/results.h"

namespace tonetool::sequence {

inline constexpr int kLayerSide = 256;

/// JSON: a list of layers with their pictures as data URIs, of the test and of the reference where
/// there is one, read from the frame's files as they are now; "" if there is none. Layers of
/// colours are shown as light up to what 99 % of the pixels have, others from the least to the
/// largest value of 98 %; IDs as colours; magenta is what is not finite.
std::string layer_pictures_json(const FrameResult& frame);

} // namespace tonetool::sequence
