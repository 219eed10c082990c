// SPDX-License-Identifier: BSD-3-Clause
// Commands that set how the rest of the command line runs, and help.
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include "chain/commands/commands.h"
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

// Settings of the whole process, of messages and of the end of the command line, and of the
// commands that follow.
const Rows kRows = {
    command("threads N", "Number of threads (0: one per core)",
            [](Session& session, const Call& call) {
                const int threads = call.integer_argument(0, {0, 4096});
                OIIO::attribute("threads", threads);
                limit_reader_threads(threads * session.parallel);
            })
        .of_process()
        .manner(),
    command("cache MB", "Size of OpenImageIO's image cache",
            [](Session&, const Call& call) {
                OIIO::ImageCache::create()->attribute(
                    "max_memory_MB", float(call.integer_argument(0, {0, 1 << 30})));
            })
        .of_process()
        .manner(),
    command("autotile SIZE", "Tiles of OpenImageIO's image cache (0: none)",
            [](Session&, const Call& call) {
                OIIO::ImageCache::create()->attribute("autotile",
                                                      call.integer_argument(0, {0, 1 << 16}));
            })
        .of_process()
        .manner(),
    command("oiioattrib NAME VALUE", "Set an attribute of OpenImageIO", run_oiioattrib)
        .modifier("type", "TYPE", "its data type (as it looks)")
        .of_process(),
    command("version", "Print the version",
            [](Session& session, const Call&) {
                session.produced = true;
                session.print(TONETOOL_VERSION);
            }),
    command("v", "Say what is read and written",
            [](Session& session, const Call&) {
                session.verbose = true;
                session.quiet = false;
            })
        .manner()
        .keeps_header(),
    command("q", "Quiet: measurements print only warnings, failures and errors",
            [](Session& session, const Call&) {
                session.quiet = true;
                session.verbose = false;
            })
        .manner()
        .keeps_header(),
    command("debug", "Say what is done",
            [](Session& session, const Call&) { session.debug = session.verbose = true; })
        .manner(),
    command("runstats", "Print the time and the memory that the command line took",
            set_on<&Session::runstats>)
        .manner(),
    command("warnings-exit", "Exit with status 2 when there were warnings",
            set_on<&Session::warnings_exit>)
        .manner(),
    command("nostderr", "Errors and warnings go to the standard output",
            set_on<&Session::complains_to_out>),
    command("no-error-exit", "After an error go on with the next command",
            set_off<&Session::error_exit>),
    command("n", "Dry run: nothing is written", set_on<&Session::dry_run>),
    command("a", "Do operations on all subimages and MIP levels", set_on<&Session::all_subimages>),
    command("u", "Update: outputs that are newer than all inputs stay as they are",
            set_on<&Session::update>),
    command("no-clobber|noclobber", "Outputs that exist stay as they are",
            set_on<&Session::no_clobber>),
    command("no-autopremult", "Do not multiply colour by an alpha that is not associated",
            [](Session& session, const Call&) {
                session.input.config.attribute("oiio:UnassociatedAlpha", 1);
            }),
    command("autopremult", "Multiply colour by an alpha that is not associated",
            [](Session& session, const Call&) {
                if (session.input.config.find_attribute("oiio:UnassociatedAlpha"))
                    session.input.config.attribute("oiio:UnassociatedAlpha", 0);
            }),
    command("autoorient|auto-orient", "--reorient every image that is read",
            set_on<&Session::autoorient>),
    command("autocc", "Convert colour by file names, to the linear space and back",
            [](Session& session, const Call& call) {
                session.autocc = true;
                session.autocc_unpremult = call.flag("unpremult", false);
            })
        .modifier("unpremult", "0|1", "divide by alpha for that"),
    command("noautocc", "No colour conversion by file names", set_off<&Session::autocc>),
    command("native", "Pixels keep the file's data type in memory",
            [](Session& session, const Call&) { session.input.type = OIIO::TypeUnknown; }),
    command("metamerge", "Results have the metadata of all images they are made of",
            set_on<&Session::metamerge>),
};

} // namespace

Rows general_commands() {
    return kRows;
}

} // namespace tonetool::chain
