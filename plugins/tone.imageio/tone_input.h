// SPDX-License-Identifier: BSD-3-Clause
// Recipes as OpenImageIO reads them. Of all files here only exports.cpp is in the plugin alone: the
// program has this reader built in.
#pragma once

#include <OpenImageIO/imageio.h>

namespace tonetool {

OIIO::ImageInput* create_tone_input();
inline const char* kToneExtensions[] = {"tone", nullptr};

/// Makes this process read recipes without the plugin.
void register_tone_format();

} // namespace tonetool
