// How the temporary files of outputs are called, beside their targets.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <string>

namespace tonetool {

/// ".shot.exr.4711-0.exr": the extension stays, some writers look at it.
inline std::string temporary_name(const std::string& base, long process, unsigned counter) {
    return "." + base + OIIO::Strutil::fmt::format(".{}-{}", process, counter) +
           OIIO::Filesystem::extension(base);
}

inline bool is_temporary_of(const std::string& name, const std::string& base) {
    const std::string start = "." + base + ".", end = OIIO::Filesystem::extension(base);
    if (name.size() < start.size() + end.size() || name.compare(0, start.size(), start) != 0 ||
        name.compare(name.size() - end.size(), end.size(), end) != 0)
        return false;
    const std::string numbers = name.substr(start.size(), name.size() - start.size() - end.size());
    const size_t dash = numbers.find('-');
    const auto digits = [](const std::string& text) {
        return !text.empty() &&
               std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    };
    return dash != std::string::npos && digits(numbers.substr(0, dash)) &&
           digits(numbers.substr(dash + 1));
}

} // namespace tonetool
