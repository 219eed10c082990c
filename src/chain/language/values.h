// SPDX-License-Identifier: BSD-3-Clause
// Values that are checked where they are read.
#pragma once

#include <string>

#include "imagebuf/options/option.h"
#include "text/text.h"

namespace tonetool {

/// "what "value" is not a number (valid: ...)" as a CommandError, for values of any origin.
double checked_number(const std::string& what, const std::string& value, Range range);
/// The same, but that it may be a fraction: 1/125, 24000/1001.
double checked_fraction(const std::string& what, const std::string& value, Range range);
int checked_integer(const std::string& what, const std::string& value, Range range);
void check_choice(const std::string& what, const std::string& value, const Strings& valid);

/// A printf pattern with exactly one %d or %0Nd, filled in; a CommandError for anything else.
std::string with_number(const std::string& pattern, int number);

/// ", did you mean "x"?", or nothing.
std::string meant(const std::string& word, const Strings& names);

} // namespace tonetool
