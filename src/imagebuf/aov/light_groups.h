// SPDX-License-Identifier: BSD-3-Clause
// The layers that hold the light of one group of lights each.
#pragma once

#include <OpenImageIO/imageio.h>
#include <string>
#include <vector>

namespace tonetool {

struct LightGroup {
    std::string name;  ///< "key" of "ViewLayer.Combined_key"
    std::string layer; ///< the whole
    int channel[3] = {-1, -1, -1};
};

/// The light groups of a picture ("": the plain R,G,B), by name, in the order of the file. Only one
/// family of names is used, lest a light counts twice.
std::vector<LightGroup> find_light_groups(const OIIO::ImageSpec& spec, const std::string& beauty);

/// The groups of these names, or the layers; all that are found if no name is given. One that is
/// not there, or twice, is an error; finding none is not.
std::vector<LightGroup> choose_light_groups(const OIIO::ImageSpec& spec, const std::string& beauty,
                                            const std::vector<std::string>& names);

} // namespace tonetool
