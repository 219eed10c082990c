// Options that are numbers or names, checked at the border.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "imagebuf/pixels/names.h"

namespace tonetool {

/// `NAME is VALUE: must be LOW to HIGH` unless it is; NaN never is.
inline bool in_range(double value, double low, double high, const char* name, std::string& error) {
    if (value >= low && value <= high)
        return true;
    error = OIIO::Strutil::fmt::format("{} is {}: must be {} to {}", name, value, low, high);
    return false;
}

inline bool one_of(const char* what, const std::string& value,
                   const std::vector<std::string>& valid, std::string& error) {
    if (std::find(valid.begin(), valid.end(), value) != valid.end())
        return true;
    error = unknown_name(what, value, valid);
    return false;
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
