// Texts in a page: escaped, filled in, allowed.
#pragma once

#include <map>
#include <string>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// For HTML's texts and quoted attributes. Bytes that are no UTF-8 become U+FFFD, control
/// characters spaces.
std::string escaped(const std::string& text);

/// JSON for a <script> of data: the same value without a character that HTML could see.
std::string script_data(const std::string& json);

/// The template with each {{name}} replaced, once: what is filled in is not looked at again. A
/// runtime_error names one without a value.
std::string filled(const std::string& text, const std::map<std::string, std::string>& values);

/// The page's Content-Security-Policy: its own style and scripts, pictures within it, nothing else.
std::string page_policy();

/// How the page draws a status.
std::string page_class(Status status);
std::string page_sign(Status status);

} // namespace tonetool::sequence
