// SPDX-License-Identifier: BSD-3-Clause
// Texts in a page: escaping, the template, and the Content-Security-Policy.
#pragma once

#include <map>
#include <string>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// Escapes for HTML text and quoted attributes. Invalid UTF-8 becomes U+FFFD, control characters
/// become spaces.
std::string escaped(const std::string& text);

/// JSON for a <script> of data: the same value without characters that end the element.
std::string script_data(const std::string& json);

/// The template with each {{name}} replaced; replaced text is not searched again. Throws a
/// runtime_error that names a {{name}} without a value.
std::string filled(const std::string& text, const std::map<std::string, std::string>& values);

/// The page's Content-Security-Policy: its own style and scripts, embedded images, nothing else.
std::string page_policy();

/// The CSS class and the symbol of a status.
std::string page_class(Status status);
std::string page_sign(Status status);

} // namespace tonetool::sequence
