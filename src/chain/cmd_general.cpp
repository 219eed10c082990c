// Commands that set how the rest of the command line runs, and help.
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

} // namespace

std::vector<Command> general_commands() {
    const auto row = [](Strings names, Strings args, std::string help, Run run) {
        return setting(Group::General, std::move(names), std::move(args), std::move(help), run);
    };
    return {
        row({"help"}, {"[COMMAND]"}, "List all commands, or tell more about one", run_help),
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
        row({"threads"}, {"N"}, "Number of threads (0: one per core)",
            [](Session&, const Call& call) {
                OIIO::attribute("threads", call.integer_argument(0, {0, 4096}));
            }),
        row({"memory"}, {"SIZE"},
            "Peak memory of the comparisons that follow, 256M or 1G: larger images are read in "
            "bands (half of the computer's)",
            run_memory),
        row({"warnings-exit"}, {}, "Exit with status 2 when there were warnings",
            [](Session& session, const Call&) { session.warnings_exit = true; }),
    };
}

} // namespace tonetool::chain
