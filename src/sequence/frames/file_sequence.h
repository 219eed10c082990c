// The files that a pattern names: "shot.#.exr", "shot.1-10x2%04d.exr", "stereo_%V.exr".
#pragma once

#include <string>
#include <vector>

#include "sequence/frames/frame_range.h"
#include "sequence/frames/name_pattern.h"

namespace tonetool::sequence {

struct PatternOptions {
    std::string frames; ///< for patterns without numbers of their own; empty: what is on the disk
    int padding = 0;    ///< digits instead of the pattern's; 0: the pattern's
    std::vector<std::string> views{"left", "right"};
    bool lenient = false; ///< as oiiotool: ranges, and no negative numbers on the disk
};

/// Whether the word has #, @, %d, %04d, %V or %v.
bool is_pattern(const std::string& word);

/// A pattern in printf's style without its own frame range: "a.1-20#.exr" is "a.%04d.exr". Any
/// other word stays as it is.
std::string without_range(const std::string& word);

/// Whether the word has a frame range of its own: "a.1-20#.exr".
bool has_range(const std::string& word);

struct Files {
    std::vector<Item> items{};
    std::vector<std::string> names{}; ///< one each
    bool from_disk = false;           ///< and not from a range
    bool own_range = false;           ///< which the pattern has itself
    /// Of the disk: names with numbers of fewer digits than the pattern's, which are not listed,
    /// and such with numbers beyond an int.
    std::vector<std::string> narrow{}, beyond{};
};

/// The files of a pattern, by its own numbers, by options.frames or by what is on the disk.
Files list_files(const std::string& pattern, const PatternOptions& options);

/// A runtime_error where it is not certain which file has which number: two have one number, a
/// number is beyond an int, or there are files of the same name with fewer digits. For the files of
/// a range the disk is looked at for others that have one of its numbers.
void check_numbers(const std::string& pattern, const Files& files,
                   const PatternOptions& options = {});

/// The pattern with the numbers and views of `items`.
std::vector<std::string> file_names(const std::string& pattern, const PatternOptions& options,
                                    const std::vector<Item>& items);

/// The same of files to be read: one with a negative number is looked for in both forms that
/// programs give it, "a.-002.exr" and "a.-0002.exr".
std::vector<std::string> input_names(const std::string& pattern, const PatternOptions& options,
                                     const std::vector<Item>& items);

} // namespace tonetool::sequence
