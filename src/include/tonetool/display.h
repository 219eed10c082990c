// SPDX-License-Identifier: BSD-3-Clause
// Maps as images for a screen.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "tonetool/export.h"

namespace tonetool::ToneAlgo {

/// False colours for a screen: one channel of `src` (-1: the luminance of the first three), 0 to 1
/// (values beyond are clamped, NaN is 0), through one of OpenImageIO's colour maps, or through two
/// or more evenly spaced RGB triples. OpenImageIO's maps are in linear light; here they are
/// sRGB-encoded, so that a PNG shows the colours that the maps are known for, and tagged so. dst:
/// R, G, B. An unknown name is an error that lists the valid ones.
TONETOOL_API bool color_map(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src, const std::string& map,
                            int channel = 0, OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API bool color_map(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src,
                            const std::vector<float>& triples, int channel = 0, OIIO::ROI roi = {},
                            int nthreads = 0);

/// Names of the colour maps.
TONETOOL_API std::vector<std::string> color_maps();

/// sRGB-encode linear Rec.709 in place of every channel but alpha; values are clamped to [0,1],
/// NaN becomes 0. Deep images, volumes and what is sRGB-encoded already are errors.
TONETOOL_API bool encode_srgb(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src, OIIO::ROI roi = {},
                              int nthreads = 0);

} // namespace tonetool::ToneAlgo
