// SPDX-License-Identifier: BSD-3-Clause
#include "runs/runs.h"

#include <iostream>
#include <mutex>
#include <ostream>
#include <poll.h>
#include <unistd.h>

#include "chain/commands/commands.h"
#include "chain/manual/help.h"
#include "chain/manual/licenses.h"
#include "chain/session/runner.h"
#include "runs/approve.h"
#include "runs/check_run.h"
#include "runs/frames.h"
#include "runs/interruption.h"
#include "runs/loop.h"
#include "sequence/results/check_files.h"
#include "text/error.h"
#include "text/printable.h"

namespace tonetool::runs {

void know_all_commands() {
    static std::once_flag once;
    std::call_once(once, [] {
        chain::add_image_commands();
        chain::add_commands(chain::Group::Check, check_commands());
        chain::add_measuring_commands();
        chain::add_commands(chain::Group::General, chain::help_commands());
        chain::add_commands(chain::Group::General, chain::licence_commands(), true);
    });
}

namespace {

// "| head" has read enough: no error, though what was not written is no success either.
bool reader_has_gone() {
    pollfd standard_output{STDOUT_FILENO, POLLOUT, 0};
    return poll(&standard_output, 1, 0) > 0 && (standard_output.revents & (POLLERR | POLLHUP)) != 0;
}

} // namespace

int run(const Strings& given, std::ostream& out, std::ostream& err, bool workers) {
    know_all_commands();
    if (given.empty()) {
        err << chain::short_help_text();
        return 1;
    }
    int status = 0;
    const chain::ParsedLine line = chain::parse_line(given);
    chain::Session whole(out, err, line.compat ? "" : full_command_line(line, line.texts, false));
    whole.settings.compat = line.compat;
    try {
        if (is_of_store(line)) {
            const int done = run_store_line(line, out);
            out.flush();
            if (!out)
                throw CommandError("cannot write to the standard output");
            return done;
        }
        const FramePlan plan = plan_frames(line);
        std::ostream& told = sequence::has_standard_output(plan.check.words) ? err : out;
        status = run_plan(plan, told, err, workers);
        if (plan.runs.empty() && !plan.check.has("merge"))
            whole.warning("", chain::kNoOutput);
    } catch (const Interrupted& by) {
        out.flush();
        err << "tonetool: "
            << (by.kept.empty() ? "interrupted, nothing is kept (valid: --state DIR)"
                                : printable(by.kept) + "; the same command goes on")
            << std::endl;
        return by.exit_status();
    } catch (const std::exception& problem) {
        whole.error("", problem.what());
    }
    out.flush();
    if (!out && &out == &std::cout && reader_has_gone())
        status = worse(status, 1);
    else if (!out)
        whole.error("", "cannot write to the standard output");
    return worse(status, whole.exit_status());
}

} // namespace tonetool::runs
