#include "runs/runs.h"

#include <mutex>
#include <ostream>

#include "chain/runner.h"
#include "manual/help.h"
#include "measure/commands.h"
#include "runs/check_run.h"
#include "runs/frames.h"
#include "runs/loop.h"

namespace tonetool::runs {

void know_all_commands() {
    static std::once_flag once;
    std::call_once(once, [] {
        chain::add_commands(check_commands());
        chain::add_commands(measure::commands());
        chain::add_commands(manual::commands());
    });
}

int run(const Strings& words, std::ostream& out, std::ostream& err, bool workers) {
    know_all_commands();
    if (words.empty()) {
        err << manual::usage_text();
        return 1;
    }
    int status = 0;
    const bool compat = is_compat(words);
    chain::Session whole(out, err, compat ? "" : full_command_line(words, false));
    whole.compat = compat;
    try {
        const FramePlan plan = plan_frames(words);
        status = run_plan(words, plan, out, err, workers);
        if (plan.runs.empty() && !plan.check.has("merge")) {
            whole.warning("", chain::no_output);
        }
    } catch (const std::exception& problem) {
        whole.error("", problem.what());
    }
    out.flush();
    if (!out) {
        whole.error("", "cannot write to the standard output");
    }
    return worse(status, whole.exit_status());
}

} // namespace tonetool::runs
