// SPDX-License-Identifier: BSD-3-Clause
// Which subimage of a file a function works on.
#pragma once

#include <OpenImageIO/imageio.h>
#include <string>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// The choice of `find_part`.
struct PartChoice {
    int part = 0;        ///< its index
    std::string picture; ///< its beauty, as layer= names it; empty where the layer was named
    /// Beauties of other subimages and other views, which this choice leaves out; empty where the
    /// layer was named.
    std::vector<std::string> left_out;
};

namespace ToneAlgo {

/// Chooses a subimage by the headers of all subimages of the file: the one that has the layer of
/// this name, or is called so itself or by its view. Without a name: the beauty of the first view,
/// as find_color() finds it, else the first subimage with colour whose name does not say data.
/// Returns false and explains in `error` where no subimage has the layer or several could be meant.
/// find_color() then finds the same layer in the header of the chosen subimage.
TONETOOL_API bool find_part(const std::vector<OIIO::ImageSpec>& parts, const PixelOptions& options,
                            PartChoice& choice, std::string& error);

} // namespace ToneAlgo
} // namespace tonetool
