// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/stray_files.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <regex>
#include <system_error>

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

// The names in a folder. All frames of a shot ask for the same ones.
Names names_in(const fs::path& folder) {
    struct Listing {
        fs::file_time_type written;
        Names names;
    };
    static std::mutex mutex;
    static std::map<std::string, Listing> listings;
    const std::lock_guard<std::mutex> lock(mutex);
    std::error_code error;
    const fs::file_time_type written = fs::last_write_time(folder, error);
    const auto known = listings.find(folder.string());
    if (!error && known != listings.end() && known->second.written == written)
        return known->second.names;
    Names names;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        names.push_back(at->path().filename().string());
    std::sort(names.begin(), names.end());
    listings[folder.string()] = {written, names};
    return names;
}

// A name of a frame: "shot.", "1013", ".exr".
struct FrameName {
    std::string stem, digits, extension;
};

bool is_decimal(char c) {
    return c >= '0' && c <= '9';
}

std::optional<int> number_of(const std::string& digits) {
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return error == std::errc() && end == digits.data() + digits.size() ? std::optional(number)
                                                                        : std::nullopt;
}

// The last group of digits that is this number.
std::optional<FrameName> split_name(const std::string& name, int number) {
    for (size_t end = name.size(); end > 0; --end) {
        if (!is_decimal(name[end - 1]))
            continue;
        size_t begin = end - 1;
        while (begin > 0 && is_decimal(name[begin - 1]))
            --begin;
        const std::string digits = name.substr(begin, end - begin);
        if (number_of(digits) == number)
            return FrameName{name.substr(0, begin), digits, name.substr(end)};
        end = begin + 1;
    }
    return std::nullopt;
}

bool starts_with_stem(const std::string& name, const std::string& stem) {
    return name.compare(0, stem.size(), stem) == 0;
}

// The digits after the stem, and what follows them.
FrameName after_stem(const std::string& name, const std::string& stem) {
    size_t end = stem.size();
    while (end < name.size() && is_decimal(name[end]))
        ++end;
    return {stem, name.substr(stem.size(), end - stem.size()), name.substr(end)};
}

// What follows the number of a frame in the name of a file that is none.
bool is_stray(const FrameName& other, const FrameName& frame) {
    const std::string& rest = other.extension;
    const std::string& extension = frame.extension;
    if (rest == extension)
        return other.digits != frame.digits; // other padding
    static const std::regex leftover("(\\.(tmp|part|partial|bak|old|swp|filepart|crdownload)|~)"),
        copy("( ?\\(\\d+\\)|[ _-]?[Cc]opy( \\d+)?|\\.\\d+)");
    if (starts_with_stem(rest, extension))
        return std::regex_match(rest.substr(extension.size()), leftover);
    const size_t length = rest.size() - std::min(rest.size(), extension.size());
    return rest.compare(length, std::string::npos, extension) == 0 &&
           std::regex_match(rest.substr(0, length), copy);
}

} // namespace

StrayFiles stray_files(const std::string& file, int number) {
    StrayFiles strays{{}, number, number, 0};
    const fs::path path(file);
    const auto frame = split_name(path.filename().string(), number);
    if (!frame)
        return strays;
    strays.digits = int(frame->digits.size());
    for (const std::string& name :
         names_in(path.parent_path().empty() ? "." : path.parent_path())) {
        if (!starts_with_stem(name, frame->stem))
            continue;
        const FrameName other = after_stem(name, frame->stem);
        const auto found = number_of(other.digits);
        if (!found)
            continue;
        if (*found == number && is_stray(other, *frame))
            strays.names.push_back(name);
        if (other.extension == frame->extension && other.digits.size() == frame->digits.size()) {
            strays.first = std::min(strays.first, *found);
            strays.last = std::max(strays.last, *found);
        }
    }
    return strays;
}

} // namespace tonetool::sequence
