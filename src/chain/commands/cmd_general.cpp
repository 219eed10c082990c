// SPDX-License-Identifier: BSD-3-Clause
// Commands that set how the rest of the command line runs, and help.
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include "chain/session/ops.h"
#include "tonetool/export.h"

namespace tonetool::chain {

namespace {

void run_oiioattrib(Session& session, const Call& call) {
    const std::string &name = call.argument(0), &value = call.argument(1);
    const std::string type = call.text("type").value_or("");
    auto whole = parse_integer(value);
    auto number = parse_number(value);
    bool known = type == "string" || (type.empty() && !number) ? OIIO::attribute(name, value)
                 : type == "float" || !whole ? OIIO::attribute(name, float(number.value_or(0)))
                                             : OIIO::attribute(name, *whole);
    if (!known && !session.compat)
        throw CommandError("unknown attribute \"" + name + "\" of OpenImageIO");
}

template <bool Session::*Flag>
void set_on(Session& session, const Call&) {
    session.*Flag = true;
}

template <bool Session::*Flag>
void set_off(Session& session, const Call&) {
    session.*Flag = false;
}

Command row(const char* usage, const char* help, Run run, const char* modifiers = "") {
    return free_row(Group::General, usage, 0, 0, help, std::move(run), modifiers);
}

// Settings of messages and of the end of the command line.
std::vector<Command> talk_rows() {
    return {
        row("version", "Print the version",
            [](Session& session, const Call&) {
                session.produced = true;
                session.print(TONETOOL_VERSION);
            }),
        keeping_header(of_manner(row("v", "Say what is read and written",
                                     [](Session& session, const Call&) {
                                         session.verbose = true;
                                         session.quiet = false;
                                     }))),
        keeping_header(
            of_manner(row("q", "Quiet: measurements print only warnings, failures and errors",
                          [](Session& session, const Call&) {
                              session.quiet = true;
                              session.verbose = false;
                          }))),
        of_manner(
            row("debug", "Say what is done",
                [](Session& session, const Call&) { session.debug = session.verbose = true; })),
        of_manner(row("runstats", "Print the time and the memory that the command line took",
                      set_on<&Session::runstats>)),
        of_manner(row("warnings-exit", "Exit with status 2 when there were warnings",
                      set_on<&Session::warnings_exit>)),
        row("nostderr", "Errors and warnings go to the standard output",
            set_on<&Session::complains_to_out>),
        row("no-error-exit", "After an error go on with the next command",
            set_off<&Session::error_exit>),
    };
}

// Settings of the commands that follow.
std::vector<Command> work_rows() {
    return {
        row("n", "Dry run: nothing is written", set_on<&Session::dry_run>),
        row("a", "Do operations on all subimages and MIP levels", set_on<&Session::all_subimages>),
        row("u", "Update: outputs that are newer than all inputs stay as they are",
            set_on<&Session::update>),
        row("no-clobber|noclobber", "Outputs that exist stay as they are",
            set_on<&Session::no_clobber>),
        row("no-autopremult", "Do not multiply colour by an alpha that is not associated",
            [](Session& session, const Call&) {
                session.input.config.attribute("oiio:UnassociatedAlpha", 1);
            }),
        row("autopremult", "Multiply colour by an alpha that is not associated",
            [](Session& session, const Call&) {
                if (session.input.config.find_attribute("oiio:UnassociatedAlpha"))
                    session.input.config.attribute("oiio:UnassociatedAlpha", 0);
            }),
        row("autoorient|auto-orient", "--reorient every image that is read",
            set_on<&Session::autoorient>),
        row(
            "autocc", "Convert colour by file names, to the linear space and back",
            [](Session& session, const Call& call) {
                session.autocc = true;
                session.autocc_unpremult = call.flag("unpremult", false);
            },
            "unpremult=0|1: divide by alpha for that"),
        row("noautocc", "No colour conversion by file names", set_off<&Session::autocc>),
        row("native", "Pixels keep the file's data type in memory",
            [](Session& session, const Call&) { session.input.type = OIIO::TypeUnknown; }),
        row("metamerge", "Results have the metadata of all images they are made of",
            set_on<&Session::metamerge>),
    };
}

// Settings of the whole process.
std::vector<Command> process_rows() {
    return {
        of_manner(row("threads N", "Number of threads (0: one per core)",
                      [](Session& session, const Call& call) {
                          const int threads = call.integer_argument(0, {0, 4096});
                          OIIO::attribute("threads", threads);
                          limit_reader_threads(threads * session.parallel);
                      })),
        of_manner(row("cache MB", "Size of OpenImageIO's image cache",
                      [](Session&, const Call& call) {
                          OIIO::ImageCache::create()->attribute(
                              "max_memory_MB", float(call.integer_argument(0, {0, 1 << 30})));
                      })),
        of_manner(row("autotile SIZE", "Tiles of OpenImageIO's image cache (0: none)",
                      [](Session&, const Call& call) {
                          OIIO::ImageCache::create()->attribute(
                              "autotile", call.integer_argument(0, {0, 1 << 16}));
                      })),
        row("oiioattrib NAME VALUE", "Set an attribute of OpenImageIO", run_oiioattrib,
            "type=TYPE: its data type (as it looks)"),
    };
}

} // namespace

std::vector<Command> general_commands() {
    std::vector<Command> all = process_rows();
    for (Command& command : all)
        command.of_process = true;
    append(all, talk_rows());
    append(all, work_rows());
    return all;
}

} // namespace tonetool::chain
