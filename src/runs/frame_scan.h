// SPDX-License-Identifier: BSD-3-Clause
// What a command line says about its frames, on the way to their plan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runs/frames.h"
#include "sequence/frames/file_sequence.h"
#include "sequence/frames/pairing.h"

namespace tonetool::runs {

/// The place of a word with wildcards.
struct Pattern {
    size_t at;
    bool is_output;
};

struct Scan {
    FramePlan plan;
    std::string directory{};
    sequence::PatternOptions options;
    std::optional<std::string> views; ///< of --views, as it was given
    std::vector<Pattern> patterns;
    bool for_images = false;
    Strings absent; ///< what is said of named cases that are missing, one for each; else empty
    std::vector<sequence::Item> tests; ///< of the second sequence, where they are others
    std::vector<size_t> same; ///< words that --wildcardoff says to be the same in all frames

    const Strings& texts() const { return plan.line.texts; }
};

/// Reads the settings and the wildcards of the whole line.
Scan scan_line(chain::ParsedLine line, bool for_images = false);

/// The frames of cases with names: what their files are, and what the outputs are called.
void pair_named_cases(Scan& scan, std::vector<sequence::Files>& listings);
/// Whether an image that is read has %N or %M in its name; else they are plain text everywhere.
bool settle_names(Scan& scan);

/// The frames of --frames, without views.
std::vector<sequence::Item> frames_given(const Scan& scan);

/// A CommandError where --frames was given and no name takes it: that would check the same files
/// again and again, or others.
void check_range_is_used(const Scan& scan, const std::vector<sequence::Side>& sides);

/// A CommandError where a view of --views has no name or is there twice.
void check_view_names(const Scan& scan);

/// A CommandError where --views was given and no name takes it, as its views would be checked
/// nowhere, and where two views of a frame are one file.
void check_views_are_used(const Scan& scan, const std::vector<sequence::Side>& sides);

/// A view that %V stands for is missing though no file of it is on the disk.
void add_missing_views(sequence::Pairing& pairs, const std::vector<sequence::Side>& sides,
                       const sequence::PatternOptions& options);

} // namespace tonetool::runs
