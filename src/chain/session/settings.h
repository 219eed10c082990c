// SPDX-License-Identifier: BSD-3-Clause
// What the commands of a line set for those that follow.
#pragma once

#include <OpenImageIO/color.h>
#include <memory>
#include <string>

#include "chain/images/inspect.h"
#include "chain/images/output.h"
#include "sequence/results/diff_limits.h"

namespace tonetool::chain {

struct Settings {
    bool compat = false;        ///< lenient as oiiotool is
    bool all_subimages = false; ///< -a: and all MIP levels
    bool dry_run = false, no_clobber = false, update = false, debug = false, runstats = false;
    bool verbose = false, quiet = false, warnings_exit = false, error_exit = true;
    bool details = false; ///< -v anywhere in the line: measurements print all that they found
    bool evaluate = true; ///< {expressions} are replaced by their values
    bool autocc = false, autocc_unpremult = false, autoorient = false;
    bool complains_to_out = false; ///< errors and warnings go to the standard output
    bool metamerge = false;        ///< results have the metadata of all inputs

    ReadOptions input;
    std::string missing_file = "error"; ///< or what stands in for it: "black", "checker"
    OutputSettings output;
    sequence::DiffLimits diff;
    Listing list; ///< what is printed of files as they are read

    std::string color_config; ///< file of the OpenColorIO configuration; empty: $OCIO
    std::shared_ptr<OIIO::ColorConfig> ocio; ///< what is in it, once it is needed
    uint64_t memory = 0; ///< bound of the comparisons in bytes; 0: none was given
    int parallel = 1;    ///< frames that share that memory

    /// Files are described when they are read.
    bool listing() const { return list.info || list.stats || list.hash || list.dump; }
};

} // namespace tonetool::chain
