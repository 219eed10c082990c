// SPDX-License-Identifier: BSD-3-Clause
// --help.
#include <algorithm>
#include <ostream>

#include "chain/manual/help.h"
#include "chain/session/call.h"
#include "chain/session/session.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

void run_help(Session& session, const Call& call) {
    session.outcome.produced = true;
    if (!call.has_argument(0)) {
        session.out << help_text();
        return;
    }
    if (is_registry_format(call.argument(0))) {
        session.out << registry_text(call.argument(0));
        return;
    }
    std::string name = call.argument(0);
    name.erase(0, std::min(name.find_first_not_of('-'), size_t{2}));
    const Command* row = find_command(name);
    if (!row) {
        throw CommandError("unknown command \"" + call.argument(0) + "\", " +
                           suggest_command(name));
    }
    session.out << help_text(*row);
}

} // namespace

Rows help_commands() {
    return {command(
        "help [COMMAND]",
        "List all commands, tell more about one, or all as man, bash, zsh (completion) or json",
        run_help)};
}

} // namespace tonetool::chain
