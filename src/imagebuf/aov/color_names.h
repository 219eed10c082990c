// SPDX-License-Identifier: BSD-3-Clause
// What the name of a layer, or of a part of a file, says of its R, G, B.
#pragma once

#include <string>

namespace tonetool {

/// It is a measurement ("N", "ViewLayer.Denoising Normal", "crypto00"), not a picture.
bool is_data_name(const std::string& layer);
/// It is what renderers call the final picture ("C", "rgba", "ViewLayer.Combined").
bool is_beauty_name(const std::string& layer);

} // namespace tonetool
