// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/file_sequence.h"

#include <OpenImageIO/filesystem.h>
#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;

struct Parsed {
    std::string printf_style, frames;
};

Parsed parse(const std::string& pattern, int padding) {
    Parsed result{pattern, ""};
    if (has_names(pattern) && !is_pattern(pattern))
        return result;
    while (result.printf_style.find_first_of("#@") != std::string::npos || result.frames.empty()) {
        std::string before = result.printf_style, frames;
        if (!OIIO::Filesystem::parse_pattern(before.c_str(), padding, result.printf_style, frames))
            throw std::runtime_error("Could not parse pattern: " + pattern);
        result.frames = result.frames.empty() ? frames : result.frames;
        if (before == result.printf_style)
            break;
    }
    return result;
}

std::vector<Item> items_of(const std::vector<int>& frames, const NamePattern& pattern,
                           const PatternOptions& options) {
    std::vector<Item> items;
    for (int frame : frames) {
        if (!pattern.has_view()) {
            items.push_back({frame, ""});
            continue;
        }
        for (const std::string& view : options.views)
            items.push_back({frame, view});
    }
    return items;
}

struct Found {
    Item item;
    std::string name;
    bool operator<(const Found& o) const { return std::tie(item, name) < std::tie(o.item, o.name); }
};

// The files of one view in the folder that the pattern names.
void look_into_folder(const std::string& printf_style, const std::string& view, bool negative,
                      std::vector<Found>& found, Files& listing) {
    const size_t begin = printf_style.rfind('/') + 1; // 0 if there is no folder
    const NamePattern folder(begin == 0 ? "./" : printf_style.substr(0, begin));
    const NamePattern name(printf_style.substr(begin));
    if (folder.has_number()) // only views may have folders of their own
        return;
    const std::string place = folder.filled({0, view});
    std::error_code problem;
    for (fs::directory_iterator entry(place, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        const std::string file = entry->path().filename().string();
        const auto number = name.number_of(file, view);
        if (!number || (number->value < 0 && !negative))
            continue;
        if (!number->of_width) {
            listing.narrow.push_back(place + file);
            continue;
        }
        if (number->beyond)
            listing.beyond.push_back(place + file);
        found.push_back({{number->value, view}, place + file});
    }
    // Else half of a folder would be checked and reported as the whole.
    const bool absent =
        problem == std::errc::no_such_file_or_directory || problem == std::errc::not_a_directory;
    if (problem && !absent) {
        throw std::runtime_error("cannot list the folder \"" + place + "\" of \"" + printf_style +
                                 "\": " + problem.message());
    }
}

Files on_disk(const std::string& printf_style, const PatternOptions& options) {
    Files listing;
    listing.from_disk = true;
    std::vector<Found> found;
    const bool views = NamePattern(printf_style).has_view();
    for (const std::string& view : views ? options.views : std::vector<std::string>{""})
        look_into_folder(printf_style, view, !options.lenient, found, listing);
    std::sort(found.begin(), found.end());
    for (Found& one : found) {
        listing.items.push_back(std::move(one.item));
        listing.names.push_back(std::move(one.name));
    }
    return listing;
}

void check_each_once(const std::string& pattern, const Files& files) {
    std::map<Item, std::string> names;
    for (size_t i = 0; i < files.items.size(); ++i) {
        const Item& item = files.items[i];
        const auto [known, is_new] = names.emplace(item, files.names[i]);
        if (!is_new) {
            throw std::runtime_error("\"" + known->second + "\" and \"" + files.names[i] +
                                     "\" are both frame " + std::to_string(item.frame) + " of \"" +
                                     pattern +
                                     "\" (valid: one file for each number; more # or @ "
                                     "for more digits)");
        }
    }
}

// The files on the disk whose numbers are in `meant`.
Files with_numbers_of(const std::vector<Item>& meant, const Files& found) {
    const std::set<Item> keys(meant.begin(), meant.end());
    Files files;
    for (size_t i = 0; i < found.items.size(); ++i) {
        if (keys.count(found.items[i]) > 0) {
            files.items.push_back(found.items[i]);
            files.names.push_back(found.names[i]);
        }
    }
    return files;
}

} // namespace

bool is_pattern(const std::string& word) {
    static const std::regex wildcard("[#@]|%[0-9]*d|%[Vv]");
    return std::regex_search(word, wildcard);
}

bool has_names(const std::string& word) {
    return word.find("%N") != std::string::npos || word.find("%M") != std::string::npos;
}

std::string without_range(const std::string& word) {
    return is_pattern(word) ? parse(word, 0).printf_style : word;
}

bool has_range(const std::string& word) {
    return !own_range(word).empty();
}

std::string printf_style(const std::string& pattern, int padding) {
    return is_pattern(pattern) ? parse(pattern, padding).printf_style : pattern;
}

std::string own_range(const std::string& word) {
    return is_pattern(word) ? parse(word, 0).frames : "";
}

Files list_files(const std::string& pattern, const PatternOptions& options) {
    const Parsed parsed = parse(pattern, options.padding);
    const std::string& range = parsed.frames.empty() ? options.frames : parsed.frames;
    if (range.empty())
        return on_disk(parsed.printf_style, options);
    Files listing;
    listing.own_range = !parsed.frames.empty();
    listing.items =
        items_of(parse_frames(range, options.lenient), NamePattern(parsed.printf_style), options);
    listing.names = file_names(pattern, options, listing.items);
    return listing;
}

Files list_all_files(const std::string& pattern, PatternOptions options) {
    options.frames.clear();
    return list_files(without_range(pattern), options);
}

void check_numbers(const std::string& pattern, const Files& files, const PatternOptions& options) {
    if (!files.from_disk) {
        const Files found = on_disk(parse(pattern, options.padding).printf_style, options);
        check_each_once(pattern, with_numbers_of(files.items, found));
        return;
    }
    if (!files.beyond.empty()) {
        throw std::runtime_error("the frame number of \"" + files.beyond.front() +
                                 "\" is beyond 2147483647, so \"" + pattern +
                                 "\" cannot tell frames apart (valid: the file's name itself)");
    }
    check_each_once(pattern, files);
    if (!files.narrow.empty()) {
        const bool several = pattern.find("##") != std::string::npos;
        throw std::runtime_error("\"" + files.narrow.front() + "\" has fewer digits than \"" +
                                 pattern + "\", which does not see it (valid: " +
                                 (several
                                      ? "one # in place of several, as each stands for four digits)"
                                      : "@ for numbers without leading zeros, or --frames for the "
                                        "frames that are meant)"));
    }
}

std::vector<std::string> file_names(const std::string& pattern, const PatternOptions& options,
                                    const std::vector<Item>& items) {
    const NamePattern name(parse(pattern, options.padding).printf_style, options.names);
    std::vector<std::string> names;
    for (const Item& item : items)
        names.push_back(name.filled(item));
    return names;
}

std::vector<std::string> input_names(const std::string& pattern, const PatternOptions& options,
                                     const std::vector<Item>& items) {
    const NamePattern name(parse(pattern, options.padding).printf_style, options.names);
    std::vector<std::string> names = file_names(pattern, options, items);
    for (size_t i = 0; i < items.size(); ++i) {
        const std::string other = items[i].frame < 0 ? name.filled(items[i], true) : "";
        if (!other.empty() && !OIIO::Filesystem::exists(names[i]) &&
            OIIO::Filesystem::exists(other))
            names[i] = other;
    }
    return names;
}

} // namespace tonetool::sequence
