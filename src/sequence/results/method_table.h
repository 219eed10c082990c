// SPDX-License-Identifier: BSD-3-Clause
// --table: the numbers of named cases as a table for a paper.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

struct MethodTableOptions {
    /// "hdrflip.mean"; empty: the first of the first command over methods, else all.
    std::vector<std::string> quantities{};
    int digits = 4;                     ///< behind the decimal point, in Markdown and LaTeX
    std::vector<std::string> methods{}; ///< in that order; empty: all, in that of their bytes
};

/// What is said of cases without names.
inline constexpr char kTableNeedsNames[] = "a table has a row for each name, and no case has one "
                                           "(valid: %N in the names of the images, or "
                                           "--csv)";

enum class TableFormat { Markdown, LaTeX, Csv };

/// That of a file by its extension .md, .tex or .csv; a runtime_error for any other.
TableFormat table_format(const std::string& file);

/// A row for each name; over methods a column for each, else for each quantity. Of several frames
/// or views of a name the mean, with the standard deviation. The best number of a row is bold, and
/// the last row is the mean of the columns that have all rows: one over fewer would flatter. Throws
/// a runtime_error where there are no names, or no number of that name.
std::string method_table(const ShotResult& shot, const MethodTableOptions& options,
                         TableFormat format);

/// The cases without such a number, for an error; empty: all have it.
std::string lacking_in_table(const ShotResult& shot, const MethodTableOptions& options);

} // namespace tonetool::sequence
