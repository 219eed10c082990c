// Which frames several sequences have together: by number, or by position where explicit ranges
// say so.
#pragma once

#include <string>
#include <vector>

#include "sequence/frames/file_sequence.h"

namespace tonetool::sequence {

/// One sequence among those that are paired.
struct Side {
    std::string pattern;
    Files files; ///< from a range, or what is on the disk
};

/// What is compared with what.
struct Pairing {
    std::vector<Item> items;                     ///< the numbers and views of the frames
    std::vector<std::vector<std::string>> names; ///< of each side, one for each item
    /// Of each side, where it is paired by position and its numbers are others; else empty.
    std::vector<std::vector<Item>> own;
};

/// The union of the sides' numbers and views. Where all come from the disk, numbers in between that
/// are nowhere are there too, in steps of the greatest common divisor of all distances (of two
/// numbers alone: one): a frame that both lack is missing as well. A runtime_error beyond a million
/// frames.
std::vector<Item> paired(const std::vector<Side>& sides);

/// The frames of a check. Sides with ranges of their own that are of equal length are paired by
/// position; a range holds for sides without one; all else is paired by number. A runtime_error
/// where ranges do not fit together, or where sequences on the disk have no number in common.
Pairing pair_sides(const std::vector<Side>& sides, const PatternOptions& options);

/// A runtime_error that names the numbers where the sides, paired by position, would pair files of
/// different numbers that no range has asked for.
void check_same_numbers(const std::vector<Side>& sides);

/// A name for each item: the file's, or the one that it would have.
std::vector<std::string> names_of(const Side& side, const PatternOptions& options,
                                  const std::vector<Item>& items);

} // namespace tonetool::sequence
