// SPDX-License-Identifier: BSD-3-Clause
// --accept: faults that somebody has looked at and lets pass.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// The name of a check: the same for every run of the same command line over any frames, another
/// for any other line.
std::string check_id(const std::vector<std::string>& check);

/// A file of acceptances, as the report's page writes it.
struct Acceptances {
    std::string check; ///< check_id() of the check that they are of
    std::vector<Acceptance> accepted;
};

/// A runtime_error where the file is not one of these.
Acceptances read_acceptances(const std::string& file);

/// A runtime_error unless they are of this check.
void check_same_check(const Acceptances& acceptances, const std::vector<std::string>& check,
                      const std::string& file);

/// Makes the faults that the shot accepts mere information, and draws the status of their frames
/// anew. What is accepted already stays as it is.
void accept_faults(ShotResult& shot);

/// What the shot accepts that is not there, a sentence each.
std::vector<std::string> unused_acceptances(const ShotResult& shot);

} // namespace tonetool::sequence
