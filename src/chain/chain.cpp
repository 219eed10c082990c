#include "chain/chain.h"

#include "chain/check_run.h"
#include "chain/frames.h"
#include "chain/help.h"
#include "chain/loop.h"
#include "chain/runner.h"

namespace tonetool::chain {

int run(const Strings& words, std::ostream& out, std::ostream& err) {
    if (words.empty()) {
        err << usage_text();
        return 1;
    }
    int status = 0;
    const bool compat = is_compat(words);
    Session whole(out, err, compat ? "" : full_command_line(words, false));
    whole.compat = compat;
    try {
        const FramePlan plan = plan_frames(words);
        status = run_plan(words, plan, out, err);
        if (plan.runs.empty() && !plan.check.has("merge")) {
            whole.warning("", no_output);
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

} // namespace tonetool::chain
