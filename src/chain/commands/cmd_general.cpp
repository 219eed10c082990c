// SPDX-License-Identifier: BSD-3-Clause
// Commands that set how the rest of the command line runs, and help.
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include "chain/commands/commands.h"
#include "chain/session/ops.h"
#include "tonetool/libraries.h"

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
    if (!known && !session.settings.compat)
        throw CommandError("unknown attribute \"" + name + "\" of OpenImageIO");
}

template <bool Settings::*Flag, bool Value = true>
void set(Session& session, const Call&) {
    session.settings.*Flag = Value;
}

// Settings of the whole process, of messages and of the end of the command line, and of the
// commands that follow.
const Rows kGeneralRows = {
    command("threads N", "Number of threads (0: one per core)",
            [](Session& session, const Call& call) {
                const int threads = call.integer_argument(0, {0, 4096});
                OIIO::attribute("threads", threads);
                limit_reader_threads(threads * session.settings.parallel);
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
    command("version", "Print the version, those of the libraries, and the instruction set in use",
            [](Session& session, const Call&) {
                session.outcome.produced = true;
                session.print(TONETOOL_VERSION);
                if (!session.settings.compat)
                    session.print(join(library_versions(), "\n"));
            }),
    command("v|verbose", "Say what is read and written, and all that is measured",
            [](Session& session, const Call&) {
                session.settings.verbose = true;
                session.settings.quiet = false;
            })
        .manner()
        .keeps_header(),
    command("q|quiet", "Quiet: measurements print only warnings, failures and errors",
            [](Session& session, const Call&) {
                session.settings.quiet = true;
                session.settings.verbose = false;
            })
        .manner()
        .keeps_header(),
    command("debug", "Say what is done",
            [](Session& session, const Call&) {
                session.settings.debug = session.settings.verbose = true;
            })
        .manner(),
    command("runstats", "Print the time and the memory that the command line took",
            set<&Settings::runstats>)
        .manner(),
    command("warnings-exit", "Exit with status 2 when there were warnings",
            set<&Settings::warnings_exit>)
        .manner(),
    command("nostderr", "Errors and warnings go to the standard output",
            set<&Settings::complains_to_out>),
    command("no-error-exit", "After an error go on with the next command",
            set<&Settings::error_exit, false>),
    command("n", "Dry run: nothing is written", set<&Settings::dry_run>),
    command("a", "Do operations on all subimages and MIP levels", set<&Settings::all_subimages>),
    command("u", "Update: outputs that are newer than all inputs stay as they are",
            set<&Settings::update>),
    command("no-clobber|noclobber", "Outputs that exist stay as they are",
            set<&Settings::no_clobber>),
    command("no-autopremult", "Do not multiply colour by an alpha that is not associated",
            [](Session& session, const Call&) {
                session.settings.input.config.attribute("oiio:UnassociatedAlpha", 1);
            }),
    command("autopremult", "Multiply colour by an alpha that is not associated",
            [](Session& session, const Call&) {
                if (session.settings.input.config.find_attribute("oiio:UnassociatedAlpha"))
                    session.settings.input.config.attribute("oiio:UnassociatedAlpha", 0);
            }),
    command("autoorient|auto-orient", "--reorient every image that is read",
            set<&Settings::autoorient>),
    command("autocc", "Convert colour by file names, to the linear space and back",
            [](Session& session, const Call& call) {
                session.settings.autocc = true;
                session.settings.autocc_unpremult = call.flag("unpremult", false);
            })
        .modifier("unpremult", "0|1", "divide by alpha for that"),
    command("noautocc", "No colour conversion by file names", set<&Settings::autocc, false>),
    command("native", "Pixels keep the file's data type in memory",
            [](Session& session, const Call&) { session.settings.input.type = OIIO::TypeUnknown; }),
    command("metamerge", "Results have the metadata of all images they are made of",
            set<&Settings::metamerge>),
};

} // namespace

Rows general_commands() {
    return kGeneralRows;
}

} // namespace tonetool::chain
