// SPDX-License-Identifier: BSD-3-Clause
// Commands that make a check of a command line.
#include "runs/check_plan.h"

namespace tonetool::runs {

using chain::Call;
using chain::Command;
using chain::Group;
using chain::Session;

std::vector<Command> check_commands() {
    const auto row = [](const char* name, Strings args, const char* help) {
        Command made = chain::setting(Group::Check, {name}, std::move(args), help,
                                      [](Session&, const Call&) {});
        made.whole_line = true;
        return made;
    };
    return {
        row("json", {"FILE"}, "Write what was found in all frames, at the end, as JSON"),
        row("csv", {"FILE"}, "Write a table of all frames, a line each"),
        row("junit", {"FILE"}, "Write a test case for each frame, as CI systems read them"),
        row("report", {"FILE.html"},
            "Write a page to look at: verdict, curve, worst frames, pictures, faults"),
        row("contactsheet", {"FILE"}, "Write an image of all frames as thumbnails"),
        row("pictures", {"DIR"},
            "Keep the pictures of the report in that folder; with --merge, take them from there"),
        row("state", {"DIR"},
            "Keep each finished frame's result in that folder: a run that was killed goes on, and "
            "frames whose files have changed are checked anew"),
        row("statistics", {"FILE"},
            "Only measure the range of exposures=shot and write it, for exposures=FILE"),
        row("merge", {},
            "Join the results (--json) of parts of a shot; with --frames also those that are in "
            "none; or the FILEs of --statistics"),
    };
}

} // namespace tonetool::runs
