// The files that a pattern names: "shot.#.exr", "shot.1-10x2%04d.exr", "stereo_%V.exr".
#pragma once

#include <string>
#include <vector>

namespace tonetool::sequence {

struct Item {
    int frame = 0;
    std::string view; ///< empty where the pattern has no %V or %v
};

struct PatternOptions {
    std::string frames; ///< for patterns without numbers of their own; empty: what is on the disk
    int padding = 0;    ///< digits instead of the pattern's; 0: the pattern's
    std::vector<std::string> views{"left", "right"};
};

/// Whether the word has #, @, %d, %04d, %V or %v.
bool is_pattern(const std::string& word);

/// A pattern in printf's style without its own frame range: "a.1-20#.exr" is "a.%04d.exr". Any
/// other word stays as it is.
std::string without_range(const std::string& word);

/// "1-10", "1,3,5-9", "1-10x2", "10-1", "1-10y3". A runtime_error for anything else.
std::vector<int> parse_frames(const std::string& range);

struct Files {
    std::vector<Item> items;
    std::vector<std::string> names; ///< one each
    bool from_disk = false;         ///< and not from a range
};

/// The files of a pattern, by its own numbers, by options.frames or by what is on the disk.
Files list_files(const std::string& pattern, const PatternOptions& options);

/// The pattern with the numbers and views of `items`.
std::vector<std::string> file_names(const std::string& pattern, const PatternOptions& options,
                                    const std::vector<Item>& items);

} // namespace tonetool::sequence
