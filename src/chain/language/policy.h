// SPDX-License-Identifier: BSD-3-Clause
// What a chain may do that is run for its images, and where its files are.
#pragma once

#include <cstddef>
#include <string>

namespace tonetool::chain {

struct Policy {
    /// Commands whose effect outlives the chain (files, settings of the process) are errors.
    bool read_only = true;
    std::string directory; ///< of relative file names; empty: the current one
    size_t max_words = 0;  ///< that are run, loops included; 0: any number
};

} // namespace tonetool::chain
