// SPDX-License-Identifier: BSD-3-Clause
// What a dailies check looks at in headers, and the parts of a file as if they were one image.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <vector>

#include "imagebuf/aov/aov_layers.h"
#include "imagebuf/aov/light_groups.h"
#include "tonetool/qc.h"

namespace tonetool {

/// A hash of 128 bits, in hexadecimal digits.
std::string fingerprint(const void* data, size_t bytes);

QcPart part_facts(const OIIO::ImageBuf& image);

/// The channels of all parts in one header: those of later parts that have plain names, or names
/// that are taken, bear the name of their part.
OIIO::ImageSpec joined_spec(const std::vector<const OIIO::ImageBuf*>& parts);
/// Name and type of each of them.
std::vector<std::pair<std::string, std::string>>
channel_facts(const OIIO::ImageSpec& joined, const std::vector<const OIIO::ImageBuf*>& parts);

/// "picture", "light", "color", "albedo", "depth", "position", "normal", "motion", "id", "data".
std::string layer_kind(const AovLayer& layer, const ColorChoice& picture,
                       const std::vector<LightGroup>& groups);

/// Whether the name of a layer says that it is a mean of samples, which is noise.
bool is_filtered(const std::string& name);

/// Of layers of IDs: whether these are of objects, not of materials or assets.
bool is_of_objects(const std::string& name);

/// Whether the values of a layer, by its kind and name, tell the moment of its frame: those of a
/// sample in the middle of the pixel do, a mean of samples is noise.
bool is_exact(const std::string& kind, const std::string& name);

} // namespace tonetool
