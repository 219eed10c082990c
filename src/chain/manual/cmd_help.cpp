// SPDX-License-Identifier: BSD-3-Clause
// --help and -h.
#include <ostream>

#include "chain/manual/help.h"
#include "chain/session/call.h"
#include "chain/session/session.h"

namespace tonetool::chain {

namespace {

void run_help(Session& session, const Call& call) {
    session.outcome.produced = true;
    const std::string what = call.has_argument(0) ? call.argument(0) : "";
    session.out << (what.empty()               ? help_text()
                    : is_registry_format(what) ? registry_text(what)
                                               : help_about(what));
}

} // namespace

Rows help_commands() {
    return {command("help [COMMAND]",
                    "List all commands, tell more about one or about a subject, or all as man, "
                    "bash, zsh, fish (completion) or json",
                    run_help),
            command("h", "Print the first page of help", [](Session& session, const Call&) {
                session.outcome.produced = true;
                session.out << short_help_text();
            })};
}

} // namespace tonetool::chain
