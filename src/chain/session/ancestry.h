// SPDX-License-Identifier: BSD-3-Clause
// What images carry on of those that they are made of.
#pragma once

#include "chain/session/call.h"
#include "chain/session/session.h"

namespace tonetool::chain {

/// Fills lineage and left_out of the images that a command has pushed, those of the stack from
/// `first` on, from the images that it has popped.
void note_ancestry(const Session& session, const Call& call, size_t first);

} // namespace tonetool::chain
