// Attributes of images: setting them from text, and what they are in expressions.
#pragma once

#include <optional>
#include <string>

#include "chain/images/image.h"

namespace tonetool::chain {

/// "3", "0.5", "a text", "01:02:03:04" of a time code, "30/1", "\"a\", \"b\"" of string arrays. Of
/// an unknown type: what the value looks like. An empty value erases the attribute.
void set_attribute(OIIO::ImageSpec& spec, const std::string& name, const std::string& value,
                   OIIO::TypeDesc type);

/// Adds a word to the Keywords, each of which is there once.
void add_keyword(OIIO::ImageSpec& spec, const std::string& word);

/// The ICC profile from and to a file; a CommandError if that fails.
void read_icc_profile(OIIO::ImageSpec& spec, const std::string& filename);
void write_icc_profile(const OIIO::ImageSpec& spec, const std::string& filename);

/// An attribute of the header, "filename", "geom", "META", "STATS", "MAXCOLOR" and the like;
/// nullopt for what the image has not.
std::optional<std::string> attribute_text(const Image& image, const std::string& name);

} // namespace tonetool::chain
