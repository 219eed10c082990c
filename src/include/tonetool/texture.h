// SPDX-License-Identifier: BSD-3-Clause
// Writing textures so that a failed or interrupted run never harms the file that was there.
#pragma once

#include <OpenImageIO/imagebufalgo.h>
#include <string>

#include "tonetool/export.h"

namespace tonetool {

/// Write a texture as ImageBufAlgo::make_texture makes it with this `config`: tiles, MIP levels.
/// The promise is that of write_images: the target is either the old file or the whole new one and
/// keeps its rights; a full disk is an error. A device or pipe is refused.
TONETOOL_API bool write_texture(OIIO::ImageBufAlgo::MakeTextureMode mode,
                                const OIIO::ImageBuf& image, const std::string& filename,
                                const OIIO::ImageSpec& config, std::string& error);

} // namespace tonetool
