// Commands that set how the rest of the command line runs, and help.
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/sysutil.h>
#include <algorithm>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "chain/call.h"
#include "chain/error.h"
#include "chain/help.h"
#include "chain/session.h"
#include "include/tonetool/export.h"

namespace tonetool::chain {

namespace {

void run_help(Session& session, const Call& call) {
    session.produced = true;
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

// Per thread OpenEXR's decoder holds blocks of rows of the whole width.
constexpr int threads_within_memory = 2;

// glibc keeps freed blocks of up to 32 MB for itself, and some for each thread; within a bound they
// go back to the system.
void give_memory_back() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 20);
    mallopt(M_ARENA_MAX, 2);
#endif
}

void run_memory(Session& session, const Call& call) {
    auto size = parse_size(call.argument(0));
    if (!size) {
        throw CommandError("SIZE \"" + call.argument(0) +
                           "\": not a size; valid: bytes, or a whole number with K, M or G "
                           "(powers of 1024), above 0: 268435456, 256M, 1G");
    }
    session.memory = *size / uint64_t(session.parallel);
    int cores = static_cast<int>(OIIO::Sysutil::hardware_concurrency());
    OIIO::attribute("exr_threads", std::min(cores, threads_within_memory));
    give_memory_back();
}

void run_oiioattrib(Session& session, const Call& call) {
    const std::string &name = call.argument(0), &value = call.argument(1);
    const std::string type = call.text("type").value_or("");
    auto whole = parse_integer(value);
    auto number = parse_number(value);
    bool known = type == "string" || (type.empty() && !number) ? OIIO::attribute(name, value)
                 : type == "float" || !whole ? OIIO::attribute(name, float(number.value_or(0)))
                                             : OIIO::attribute(name, *whole);
    if (!known && !session.compat) {
        throw CommandError("unknown attribute \"" + name + "\" of OpenImageIO");
    }
}

} // namespace

std::vector<Command> general_commands() {
    const auto row = [](Strings names, Strings args, std::string help, Run run) {
        return setting(Group::General, std::move(names), std::move(args), std::move(help), run);
    };
    Command autocc =
        row({"autocc"}, {}, "Convert colour by file names, to the linear space and back",
            [](Session& session, const Call& call) {
                session.autocc = true;
                session.autocc_unpremult = call.flag("unpremult", false);
            });
    autocc.modifiers = {{"unpremult", "0|1", "divide by alpha for that"}};
    Command oiioattrib =
        row({"oiioattrib"}, {"NAME", "VALUE"}, "Set an attribute of OpenImageIO", run_oiioattrib);
    oiioattrib.modifiers = {{"type", "TYPE", "its data type (as it looks)"}};
    return {
        row({"help"}, {"[COMMAND]"},
            "List all commands, tell more about one, or all as man, bash, zsh (completion) or json",
            run_help),
        row({"version"}, {}, "Print the version",
            [](Session& session, const Call&) {
                session.produced = true;
                session.print(TONETOOL_VERSION);
            }),
        row({"v"}, {}, "Say what is read and written",
            [](Session& session, const Call&) {
                session.verbose = true;
                session.quiet = false;
            }),
        row({"q"}, {}, "Quiet: measurements print only warnings, failures and errors",
            [](Session& session, const Call&) {
                session.quiet = true;
                session.verbose = false;
            }),
        row({"n"}, {}, "Dry run: nothing is written",
            [](Session& session, const Call&) { session.dry_run = true; }),
        row({"a"}, {}, "Do operations on all subimages and MIP levels",
            [](Session& session, const Call&) { session.all_subimages = true; }),
        of_process(row({"threads"}, {"N"}, "Number of threads (0: one per core)",
                       [](Session&, const Call& call) {
                           OIIO::attribute("threads", call.integer_argument(0, {0, 4096}));
                       })),
        of_process(
            row({"memory"}, {"SIZE"},
                "Peak memory of the comparisons that follow, 256M or 1G: larger images are read in "
                "bands (half of the computer's)",
                run_memory)),
        row({"no-error-exit"}, {}, "After an error go on with the next command",
            [](Session& session, const Call&) { session.error_exit = false; }),
        row({"debug"}, {}, "Say what is done",
            [](Session& session, const Call&) { session.debug = session.verbose = true; }),
        row({"runstats"}, {}, "Print the time and the memory that the command line took",
            [](Session& session, const Call&) { session.runstats = true; }),
        row({"u"}, {}, "Update: outputs that are newer than all inputs stay as they are",
            [](Session& session, const Call&) { session.update = true; }),
        row({"no-clobber"}, {}, "Outputs that exist stay as they are",
            [](Session& session, const Call&) { session.no_clobber = true; }),
        row({"no-autopremult"}, {}, "Do not multiply colour by an alpha that is not associated",
            [](Session& session, const Call&) {
                session.input.config.attribute("oiio:UnassociatedAlpha", 1);
            }),
        row({"autopremult"}, {}, "Multiply colour by an alpha that is not associated",
            [](Session& session, const Call&) {
                if (session.input.config.find_attribute("oiio:UnassociatedAlpha")) {
                    session.input.config.attribute("oiio:UnassociatedAlpha", 0);
                }
            }),
        row({"autoorient"}, {}, "--reorient every image that is read",
            [](Session& session, const Call&) { session.autoorient = true; }),
        autocc,
        row({"noautocc"}, {}, "No colour conversion by file names",
            [](Session& session, const Call&) { session.autocc = false; }),
        row({"native"}, {}, "Pixels keep the file's data type in memory",
            [](Session& session, const Call&) { session.input.type = OIIO::TypeUnknown; }),
        of_process(row(
            {"cache"}, {"MB"}, "Size of OpenImageIO's image cache",
            [](Session&, const Call& call) {
                auto* cache = OIIO::ImageCache::create();
                cache->attribute("max_memory_MB", float(call.integer_argument(0, {0, 1 << 30})));
            })),
        of_process(row({"autotile"}, {"SIZE"}, "Tiles of OpenImageIO's image cache (0: none)",
                       [](Session&, const Call& call) {
                           auto* cache = OIIO::ImageCache::create();
                           cache->attribute("autotile", call.integer_argument(0, {0, 1 << 16}));
                       })),
        row({"metamerge"}, {}, "Results have the metadata of all images they are made of",
            [](Session& session, const Call&) { session.metamerge = true; }),
        of_process(oiioattrib),
        row({"warnings-exit"}, {}, "Exit with status 2 when there were warnings",
            [](Session& session, const Call&) { session.warnings_exit = true; }),
    };
}

} // namespace tonetool::chain
