#include "sequence/file_sequence.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <regex>
#include <stdexcept>

namespace tonetool::sequence {

namespace {

struct Parsed {
    std::string printf_style, frames;
};

Parsed parse(const std::string& pattern, int padding) {
    Parsed result{pattern, ""};
    while (result.printf_style.find_first_of("#@") != std::string::npos || result.frames.empty()) {
        std::string before = result.printf_style, frames;
        if (!OIIO::Filesystem::parse_pattern(before.c_str(), padding, result.printf_style,
                                             frames)) {
            throw std::runtime_error("Could not parse pattern: " + pattern);
        }
        result.frames = result.frames.empty() ? frames : result.frames;
        if (before == result.printf_style) {
            break;
        }
    }
    return result;
}

bool has_view(const std::string& pattern) {
    return pattern.find("%V") != std::string::npos || pattern.find("%v") != std::string::npos;
}

std::string filled(const std::string& pattern, const Item& item) {
    std::string name;
    for (size_t at = 0; at < pattern.size(); ++at) {
        size_t end = at + 1;
        while (pattern[at] == '%' && end < pattern.size() && isdigit(pattern[end])) {
            ++end;
        }
        char kind = pattern[at] == '%' && end < pattern.size() ? pattern[end] : '\0';
        if (kind == 'd') {
            int width = end > at + 1 ? OIIO::Strutil::stoi(pattern.substr(at + 1)) : 0;
            name += OIIO::Strutil::fmt::format("{:0{}d}", item.frame, width);
            at = end;
        } else if ((kind == 'V' || kind == 'v') && end == at + 1 && !item.view.empty()) {
            name += kind == 'V' ? item.view : item.view.substr(0, 1);
            at = end;
        } else {
            name += pattern[at];
        }
    }
    return name;
}

std::vector<Item> items_of(const std::vector<int>& frames, const std::string& pattern,
                           const PatternOptions& options) {
    std::vector<Item> items;
    for (int frame : frames) {
        if (!has_view(pattern)) {
            items.push_back({frame, ""});
            continue;
        }
        for (const std::string& view : options.views) {
            items.push_back({frame, view});
        }
    }
    return items;
}

} // namespace

bool is_pattern(const std::string& word) {
    static const std::regex wildcard("[#@]|%[0-9]*d|%[Vv]");
    return std::regex_search(word, wildcard);
}

std::string without_range(const std::string& word) {
    return is_pattern(word) ? parse(word, 0).printf_style : word;
}

std::vector<int> parse_frames(const std::string& range) {
    std::vector<int> frames;
    if (!OIIO::Filesystem::enumerate_sequence(range, frames) || frames.empty()) {
        throw std::runtime_error("no frame range: \"" + range +
                                 "\" (valid: 1-10, 1,3,5-9, 1-10x2)");
    }
    return frames;
}

Files list_files(const std::string& pattern, const PatternOptions& options) {
    Parsed parsed = parse(pattern, options.padding);
    const std::string& range = parsed.frames.empty() ? options.frames : parsed.frames;
    Files listing;
    if (!range.empty()) {
        listing.items = items_of(parse_frames(range), pattern, options);
        listing.names = file_names(pattern, options, listing.items);
        return listing;
    }
    std::vector<OIIO::string_view> views(options.views.begin(), options.views.end()), found;
    std::vector<int> frames;
    OIIO::Filesystem::scan_for_matching_filenames(parsed.printf_style, views, frames, found,
                                                  listing.names);
    for (size_t i = 0; i < listing.names.size(); ++i) {
        listing.items.push_back({i < frames.size() ? frames[i] : 0,
                                 i < found.size() ? std::string(found[i]) : std::string()});
    }
    listing.from_disk = true;
    return listing;
}

std::vector<std::string> file_names(const std::string& pattern, const PatternOptions& options,
                                    const std::vector<Item>& items) {
    const std::string printf_style = parse(pattern, options.padding).printf_style;
    std::vector<std::string> names;
    for (const Item& item : items) {
        names.push_back(filled(printf_style, item));
    }
    return names;
}

} // namespace tonetool::sequence
