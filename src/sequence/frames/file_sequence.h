// SPDX-License-Identifier: BSD-3-Clause
// The files that a pattern names: "shot.#.exr", "shot.1-10x2%04d.exr", "stereo_%V.exr".
#pragma once

#include <string>
#include <vector>

#include "sequence/frames/frame_range.h"
#include "sequence/frames/name_pattern.h"

namespace tonetool::sequence {

struct PatternOptions {
    /// Frame range for patterns without their own; empty: the files on the disk.
    std::string frames;
    int padding = 0; ///< digits of frame numbers; 0: as the pattern says
    std::vector<std::string> views{"left", "right"};
    /// As oiiotool: tolerant of malformed ranges, and without negative numbers on the disk.
    bool lenient = false;
    /// %N and %M are wildcards, for the names and methods of cases.
    bool names = false;
};

/// Whether the word has #, @, %d, %04d, %V or %v.
bool is_pattern(const std::string& word);

/// Whether it has %N or %M.
bool has_names(const std::string& word);

/// A pattern in printf's style without its own frame range: "a.1-20#.exr" is "a.%04d.exr". Any
/// other word stays as it is.
std::string without_range(const std::string& word);

/// Whether the word has a frame range of its own: "a.1-20#.exr".
bool has_range(const std::string& word);
/// The pattern in printf's style, its numbers of so many digits (0: as it says), without a range.
std::string printf_style(const std::string& pattern, int padding);

/// The range; empty where it has none.
std::string own_range(const std::string& word);

struct Files {
    std::vector<Item> items{};
    std::vector<std::string> names{}; ///< one for each item
    bool from_disk = false;           ///< the files were found on the disk, not listed by a range
    bool own_range = false;           ///< the range is the pattern's own
    /// That are known to have been, without a file.
    std::vector<Item> lost{};
    /// Of "out/%M/...": folders of methods without any file.
    std::vector<std::string> empty_methods{};
    /// If the files come from the disk: names whose numbers have fewer digits than the pattern asks
    /// for, which are not listed, and names whose numbers exceed an int.
    std::vector<std::string> narrow{}, beyond{};
};

/// The files of a pattern: by its own frame range, by options.frames, or by the files on the disk.
Files list_files(const std::string& pattern, const PatternOptions& options);
/// Those on the disk, whatever frames are asked for.
Files list_all_files(const std::string& pattern, PatternOptions options);

/// Throws a runtime_error where it is not certain which file has which number: two files have the
/// same number, a number exceeds an int, or there are files of the same name with fewer digits. For
/// the files of a range the disk is looked at for others that have one of its numbers.
void check_numbers(const std::string& pattern, const Files& files,
                   const PatternOptions& options = {});

/// The pattern with the numbers and views of `items`.
std::vector<std::string> file_names(const std::string& pattern, const PatternOptions& options,
                                    const std::vector<Item>& items);

/// The same for files to be read: a file with a negative number is looked for in both forms that
/// programs give it, "a.-002.exr" and "a.-0002.exr".
std::vector<std::string> input_names(const std::string& pattern, const PatternOptions& options,
                                     const std::vector<Item>& items);

} // namespace tonetool::sequence
