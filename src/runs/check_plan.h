// SPDX-License-Identifier: BSD-3-Clause
// What a command line says about a check of its frames, before any of them runs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "chain/language/line.h"
#include "sequence/frames/file_sequence.h"
#include "sequence/report/figure.h"
#include "sequence/report/report_page.h"
#include "sequence/results/method_table.h"
#include "sequence/results/results.h"
#include "text/text.h"

namespace tonetool::runs {

/// The rows of the commands that ask for a check. What they ask for is read before any frame runs
/// and done after the last one (check_run.h).
chain::Rows check_commands();

/// A command whose exposure is that of the shot.
struct ShotCommand {
    size_t at; ///< the place of its word
    chain::ShotNeed need;
};

struct CheckPlan {
    std::map<std::string, std::string> words; ///< of Group::Check, with their arguments: "json"
    std::string exposures;                    ///< of exposures=; empty: each frame has its own
    /// The commands that measure a shot, one after the other: what a later one measures may follow
    /// from what an earlier one does.
    std::vector<ShotCommand> shots;
    std::vector<size_t> inputs, outputs; ///< indices of the words that name files
    std::vector<size_t> always_written;  ///< and of those that write one in every frame
    bool compares = false;               ///< a command compares images
    bool has_limits = false;             ///< one has fail= or warn=, or is --diff
    bool dry_run = false;                ///< -n: no file is written
    bool only_validates = false;         ///< --dry-run: no frame is read either
    sequence::Status bad_from = sequence::Status::Failed; ///< of --bad-frames
    bool json_records = true;                             ///< --json has what --qc measured
    Strings part_lists;                                   ///< files of --merge-list
    Strings only;                                         ///< globs of --only
    Strings expected_check;                               ///< of the suite that parts are merged of
    sequence::PictureCounts pictures;                     ///< of --report and --pictures
    sequence::PageLimits page;                            ///< of --report
    sequence::MethodTableOptions table;
    sequence::FigureOptions figure;
    /// The words without those that say which frames, where to and how fast; and where they are.
    Strings essence;
    std::vector<size_t> essence_at;
    std::vector<sequence::Item> expected; ///< of --frames, or of the suite, for --merge

    bool has(const std::string& word) const { return words.count(word) > 0; }
    std::string argument(const std::string& word) const { return has(word) ? words.at(word) : ""; }
    /// The words that are followed: with -n those that print to the standard output.
    std::map<std::string, std::string> written() const;
    /// Where results go, also with -n: what is only read is no such place.
    std::map<std::string, std::string> written_places() const;
    /// Frames are paired by number, and what is wrong with one is a result.
    bool is_check() const { return !words.empty() && !has("statistics") && !has("merge"); }
    /// Something is passed or not: what was not compared must not be passed.
    bool judges() const {
        return is_check() || (has_limits && !has("statistics") && !has("merge"));
    }
    bool compares_pairs() const { return compares || has("against"); }
    /// Over frames the line ends with a verdict.
    bool has_verdict() const { return judges() || (compares && !has("statistics")); }
    /// So are those whose exposures are measured.
    bool pairs_frames() const { return judges() || has("statistics") || exposures == "shot"; }
    bool is_input(size_t at) const;
};

/// A CommandError where the words of a check are not whole or exclude each other.
CheckPlan plan_check(const chain::ParsedLine& line);

} // namespace tonetool::runs
