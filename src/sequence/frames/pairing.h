// SPDX-License-Identifier: BSD-3-Clause
// Pairs the frames of several sequences: by number, or by position where explicit ranges say so.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "sequence/frames/file_sequence.h"

namespace tonetool::sequence {

/// One of the sequences that are paired.
struct Side {
    std::string pattern;
    Files files;         ///< from a range, or what is on the disk
    std::string lacks{}; ///< said of a case that it has no file of; empty: the file's name
};

/// The frames that are compared with each other.
struct Pairing {
    std::vector<Item> items;                     ///< the numbers and views of the frames
    std::vector<std::vector<std::string>> names; ///< names of each side, one for each item
    /// The numbers of a side that is paired by position and has other numbers; else empty.
    std::vector<std::vector<Item>> own;
    /// Of named cases: what is said of one that a side lacks, else empty; one for each item.
    std::vector<std::string> absent{};
};

/// The union of the sides' numbers and views. Where all files come from the disk, numbers in
/// between that no side has are added, in steps of the greatest common divisor of all distances (1
/// if there are only two numbers): a frame that both sides lack is missing as well. Throws a
/// runtime_error beyond a million frames.
std::vector<Item> paired(const std::vector<Side>& sides);
/// The numbers in between, of all views that are there.
void fill_holes(std::set<Item>& keys);

/// The frames of a check. Sides with ranges of their own that are of equal length are paired by
/// position; a range holds for sides without one; all else is paired by number. Throws a
/// runtime_error where ranges do not fit together, or where sequences on the disk have no number in
/// common.
Pairing pair_sides(const std::vector<Side>& sides, const PatternOptions& options);

/// What a range in one name leaves out of what another has on the disk, as a sentence; empty where
/// that is nothing. A --frames or a range in each name says that it is meant.
std::string left_out(const std::vector<Side>& sides);

/// The numbers that a sequence on the disk lacks between its first and last, as a sentence; empty
/// where there are none, of two files, and where they are too far apart to be one.
std::string gaps(const Side& side);

/// Throws a runtime_error that names the numbers where pairing by position would pair files of
/// different numbers although no range asks for it.
void check_same_numbers(const std::vector<Side>& sides);

/// A name for each item: that of the file, or that of the missing file.
std::vector<std::string> names_of(const Side& side, const PatternOptions& options,
                                  const std::vector<Item>& items);

} // namespace tonetool::sequence
