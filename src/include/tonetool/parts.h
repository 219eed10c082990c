// Which part (subimage) of a file is looked at.
#pragma once

#include <OpenImageIO/imageio.h>
#include <string>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// What `find_part` chose.
struct PartChoice {
    int part = 0;        ///< its index
    std::string picture; ///< as layer= names it; empty where the layer was named
    /// Pictures of other parts, and of other views, that nobody looks at then; empty where the
    /// layer was named.
    std::vector<std::string> left_out;
};

namespace ToneAlgo {

/// Chooses the part of a file by the headers of all of them: the one that has or is the layer, or
/// the view, of this name; without a name the beauty, as find_color() does, of the first view; else
/// the first part with colour that its name does not call data. Returns false and explains in
/// `error` where none has the layer or several could be meant. find_color() then finds the same
/// layer in the header of the part.
TONETOOL_API bool find_part(const std::vector<OIIO::ImageSpec>& parts, const PixelOptions& options,
                            PartChoice& choice, std::string& error);

} // namespace ToneAlgo
} // namespace tonetool
