// SPDX-License-Identifier: BSD-3-Clause
// Commands that make a check of a command line.
#include "runs/check_plan.h"

namespace tonetool::runs {

using chain::command;

chain::Rows check_commands() {
    return {
        command("suite FILE",
                "Check the named cases that a suite file lists, with its limits; approved images "
                "are what a folder of them says")
            .modifier("sha256", "HEX", "only if the file has that hash")
            .whole_line(),
        command("only GLOB", "Of named cases (%N) only those, as 'hair/*'; may be there again")
            .whole_line(),
        command("key NAME", "Compare with the approved images that have that key, where there are "
                            "such; else with those without one")
            .whole_line(),
        command("approve FILE",
                "Approve images of the cases that follow ('hair/*' glass), as the JSON of a run of "
                "--suite has seen them: a line of its own, with --reason; --add keeps what is "
                "approved beside them")
            .whole_line(),
        command("reason TEXT", "Of --approve: why").whole_line(),
        command("by TEXT", "Of --approve: who (GIT_AUTHOR_NAME, else the login)").whole_line(),
        command("again", "Of --approve: also cases that passed").whole_line(),
        command("retire", "Of --approve: remove what is approved of these cases").whole_line(),
        command("approved DIR", "List the approved images of a folder and verify each")
            .whole_line(),
        command("json FILE", "Write what was found in all frames, at the end, as JSON")
            .modifier("records", "0|1",
                      "with what --qc measured (1), which --merge needs: most of the file")
            .whole_line(),
        command("csv FILE", "Write a table of all frames, a line each").whole_line(),
        command("junit FILE", "Write a test case for each frame, as CI systems read them")
            .whole_line(),
        command("table FILE",
                "Write the numbers of named cases (%N) as a table for a paper: a row for each "
                "name, a column for each method (%M) or quantity; .md, .tex or .csv")
            .modifier("quantity", "NAME,...", "as of --csv: hdrflip.mean (the first)")
            .modifier("digits", "N", "behind the decimal point, in .md and .tex (4)")
            .modifier("methods", "NAME,...", "which, in that order (all)")
            .whole_line(),
        command(
            "figure FILE",
            "Draw named cases for a paper: a row for each name with its reference, a column for "
            "each method, insets above their error maps, and the first number below")
            .modifier("names", "NAME,...", "which, in that order (all)")
            .modifier("methods", "NAME,...", "which, in that order (all)")
            .modifier("inset", "WxH+X+Y,...", "parts of the picture (whole pictures)")
            .modifier("scale", "N", "times which pixels of insets are repeated (4)")
            .modifier("stops", "X", "exposure of all pictures (the middle of the row's)")
            .modifier("text", "PIXELS", "height of the labels, 8 to 200 (16)")
            .modifier("background", "white|dark", "colour of the paper (white)")
            .whole_line(),
        command("github",
                "Print what did not pass as annotations of GitHub, and add a summary to the file "
                "that GITHUB_STEP_SUMMARY names")
            .whole_line(),
        command("ctest",
                "Print numbers, verdict and --images as measurements of CTest, which CDash shows")
            .whole_line(),
        command("summary FILE",
                "Add a heading, the verdict and a table of what did not pass, as Markdown, to the "
                "end of the file")
            .whole_line(),
        command("bad-frames FILE",
                "Write the numbers of the frames to render again, in one line as render farms read "
                "it: 1004,1006,1009-1011")
            .modifier("from", "error|warning", "the least severity that counts (error)")
            .whole_line(),
        command("accept FILE",
                "Let the faults of --qc pass that the file names, as the report's page exports it: "
                "they become info")
            .whole_line(),
        command(
            "report FILE.html",
            "Write a page to look at: verdict, curve, worst frames, scene-linear pictures, faults")
            .modifier(
                "pixels", "N",
                "of so many of the worst frames the page has the number of every pixel, about "
                "19 MB each at 1920x1080 (of one, reduced to 960x540)")
            .modifier("size", "MB", "the most that the page may take (50)")
            .whole_line(),
        command("contactsheet FILE", "Write an image of all frames as thumbnails").whole_line(),
        command(
            "pictures DIR",
            "Keep the pictures of the report in that folder; with --merge, take them from there")
            .modifier("pixels", "N", "as of --report")
            .whole_line(),
        command("images DIR",
                "Write DIR/NAME.reference.png, .test.png and .error.png of each case or frame that "
                "did not pass: both at the exposure that has the worst pixel's error, and the map "
                "in magma; with --merge, take them from there")
            .whole_line(),
        command("state DIR", "Keep each finished frame's result in that folder: a run that was "
                             "killed goes on, and frames whose files have changed are checked anew")
            .whole_line(),
        command("statistics FILE",
                "Only measure what exposures=shot or adapt=shot need and write it, for "
                "exposures=FILE or adapt=FILE")
            .whole_line(),
        command("exit-zero", "For tasks of a farm: status 0 when all results that were asked for "
                             "are written, whatever they are; needs --json, which --merge judges")
            .whole_line(),
        command("dry-run", "Only look whether the command line can run: parse it, count the frames "
                           "that are there, try the places of all results")
            .whole_line(),
        command("merge", "Join the results (--json) of parts of a shot, files, folders or names "
                         "with *; with --frames also those that are in none; or the FILEs of "
                         "--statistics")
            .whole_line(),
        command("merge-list FILE", "The same of the parts that the lines of that file name; -: of "
                                   "the standard input")
            .whole_line(),
    };
}

} // namespace tonetool::runs
