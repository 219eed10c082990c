// SPDX-License-Identifier: BSD-3-Clause
// The text of a recipe: "tonetool 1", then a chain.
#pragma once

#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>

#include "text/text.h"

namespace tonetool::recipe {

inline constexpr char kMagic[] = "tonetool 1";
inline constexpr size_t kMostBytes = 1 << 20;

/// What is wrong with a recipe, in one line.
struct RecipeError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

using Parameters = std::map<std::string, std::string>;

/// Whether a file begins as recipes do; reads no more of it than that.
bool has_magic(const std::string& filename);

/// The whole text; a RecipeError where it cannot be one.
std::string read_text(const std::string& filename);

/// The words of the chain. Words end at spaces and line ends; '...' and "..." keep them together,
/// a backslash takes the next character as it is, # at the start of a word begins a comment.
/// "$name = value" on a line of its own is the default of a parameter, and $name or ${name}
/// outside of '...' becomes its value, $$ a dollar. A RecipeError names the line.
Strings parse(const std::string& text, const Parameters& given);

} // namespace tonetool::recipe
