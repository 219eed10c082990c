// SPDX-License-Identifier: BSD-3-Clause
// What a recipe shows: its chain is run once for all who look at it.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <memory>
#include <string>
#include <vector>

#include "recipe/recipe.h"
#include "sequence/frames/file_stamp.h"

namespace tonetool::recipe {

/// A recipe by its file and the values of its parameters.
struct Source {
    std::string file;
    Parameters parameters;
};

/// From "shot.tone?frame=1012&view=ACES" and the "tone:frame" of a reader's configuration; what the
/// name says goes first. A file that has a ? in its name is that file.
Source parse_source(const std::string& name, const OIIO::ImageSpec& config);

struct Picture {
    /// Those of the top of the stack, then of the images below it from the top down, in the data
    /// types that they would be written with.
    std::vector<OIIO::ImageBuf> subimages;
    sequence::Stamps inputs; ///< the recipe and all that was read for it
    size_t bytes = 0;
};
using PicturePtr = std::shared_ptr<const Picture>;

/// Recipes that may read one another, the first one included.
inline constexpr size_t kMostNested = 16;

/// The picture, from memory if it was made before and nothing of what it is made of has changed.
/// Any thread may ask at any time. A RecipeError names the recipe and what is wrong.
PicturePtr picture_of(const Source& source);

} // namespace tonetool::recipe
