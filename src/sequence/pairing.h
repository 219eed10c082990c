// Which frames several sequences have together, each by its number.
#pragma once

#include <string>
#include <vector>

#include "sequence/file_sequence.h"

namespace tonetool::sequence {

/// One sequence among those that are paired.
struct Side {
    std::string pattern;
    Files files; ///< from a range, or what is on the disk
};

/// The union of the sides' numbers and views. Where all come from the disk, numbers in between that
/// are nowhere are there too, in steps of the greatest common divisor of all distances: a frame
/// that both lack is missing as well. A runtime_error beyond a million frames.
std::vector<Item> paired(const std::vector<Side>& sides);

/// A name for each item: the file's, or the one that it would have.
std::vector<std::string> names_of(const Side& side, const PatternOptions& options,
                                  const std::vector<Item>& items);

} // namespace tonetool::sequence
