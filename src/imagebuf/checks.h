// Options that are numbers, checked at the border.
#pragma once

#include <OpenImageIO/strutil.h>
#include <string>

namespace tonetool {

/// `NAME is VALUE: must be LOW to HIGH` unless it is; NaN never is.
inline bool in_range(double value, double low, double high, const char* name, std::string& error) {
    if (value >= low && value <= high)
        return true;
    error = OIIO::Strutil::fmt::format("{} is {}: must be {} to {}", name, value, low, high);
    return false;
}

} // namespace tonetool
