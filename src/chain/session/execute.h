// SPDX-License-Identifier: BSD-3-Clause
// One command, run on the stack.
#pragma once

#include <string>

#include "chain/session/call.h"
#include "chain/session/session.h"

namespace tonetool::chain {

/// Takes the images that the call pops, runs it, and looks whether it left what its row says.
void execute(Session& session, Call& call);

/// Runs one command on the stack, as if "--word arguments..." were next.
void run_command(Session& session, const std::string& word, Strings arguments);

/// The files that a command reads, where the session's policy says that they are.
void locate_files(Session& session, const Command& row, Token& token, Strings& arguments);

} // namespace tonetool::chain
