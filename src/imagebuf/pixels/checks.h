// SPDX-License-Identifier: BSD-3-Clause
// Options that are numbers or names, checked at the border.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"

namespace tonetool {

/// Refuses `NAME is VALUE: must be LOW to HIGH` unless it is; NaN never is.
inline void check_range(double value, double low, double high, const char* name) {
    if (!(value >= low && value <= high))
        throw Refusal(
            OIIO::Strutil::fmt::format("{} is {}: must be {} to {}", name, value, low, high));
}

/// Refuses a value that is none of the valid ones.
inline void check_one_of(const char* what, const std::string& value,
                         const std::vector<std::string>& valid) {
    if (std::find(valid.begin(), valid.end(), value) == valid.end())
        throw Refusal(unknown_name(what, value, valid));
}

/// "P.exr" where a layer could be named.
inline bool is_file(const std::string& name) {
    return !name.empty() && name != "none" && !OIIO::Filesystem::extension(name).empty() &&
           OIIO::Filesystem::is_regular(name);
}

/// A number where a name could be; nullopt for a name.
inline std::optional<double> number_of(const std::string& text) {
    if (!OIIO::Strutil::string_is_float(text))
        return std::nullopt;
    return OIIO::Strutil::stod(text);
}

} // namespace tonetool
