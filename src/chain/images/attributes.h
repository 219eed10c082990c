// SPDX-License-Identifier: BSD-3-Clause
// Attributes of images: setting them from text, and their values in expressions.
#pragma once

#include <optional>
#include <string>

#include "chain/images/image.h"

namespace tonetool::chain {

/// "3", "0.5", "a text", "01:02:03:04" of a time code, "30/1", "\"a\", \"b\"" of string arrays. The
/// type of a new attribute is guessed from the value. An empty value erases the attribute.
void set_attribute(OIIO::ImageSpec& spec, const std::string& name, const std::string& value,
                   OIIO::TypeDesc type);

/// Adds a word to the Keywords, unless it is there already.
void add_keyword(OIIO::ImageSpec& spec, const std::string& word);

/// Reads the ICC profile from a file, or writes it to one; throws a CommandError if that fails.
void read_icc_profile(OIIO::ImageSpec& spec, const std::string& filename);
void write_icc_profile(const OIIO::ImageSpec& spec, const std::string& filename);

/// An attribute of the header, "filename", "geom", "META", "STATS", "MAXCOLOR" and the like;
/// nullopt if the image has no such attribute.
std::optional<std::string> attribute_text(const Image& image, const std::string& name);

} // namespace tonetool::chain
