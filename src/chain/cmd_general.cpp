// Commands that set how the rest of the command line runs, and help.
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include "chain/call.h"
#include "chain/session.h"
#include "include/tonetool/export.h"
#include "text/error.h"

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
        row({"version"}, {}, "Print the version",
            [](Session& session, const Call&) {
                session.produced = true;
                session.print(TONETOOL_VERSION);
            }),
        of_manner(row({"v"}, {}, "Say what is read and written",
                      [](Session& session, const Call&) {
                          session.verbose = true;
                          session.quiet = false;
                      })),
        of_manner(row({"q"}, {}, "Quiet: measurements print only warnings, failures and errors",
                      [](Session& session, const Call&) {
                          session.quiet = true;
                          session.verbose = false;
                      })),
        row({"n"}, {}, "Dry run: nothing is written",
            [](Session& session, const Call&) { session.dry_run = true; }),
        row({"a"}, {}, "Do operations on all subimages and MIP levels",
            [](Session& session, const Call&) { session.all_subimages = true; }),
        of_manner(of_process(row({"threads"}, {"N"}, "Number of threads (0: one per core)",
                                 [](Session&, const Call& call) {
                                     const int threads = call.integer_argument(0, {0, 4096});
                                     OIIO::attribute("threads", threads);
                                     files::limit_reader_threads(threads);
                                 }))),
        row({"no-error-exit"}, {}, "After an error go on with the next command",
            [](Session& session, const Call&) { session.error_exit = false; }),
        of_manner(
            row({"debug"}, {}, "Say what is done",
                [](Session& session, const Call&) { session.debug = session.verbose = true; })),
        of_manner(row({"runstats"}, {}, "Print the time and the memory that the command line took",
                      [](Session& session, const Call&) { session.runstats = true; })),
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
        of_manner(of_process(row(
            {"cache"}, {"MB"}, "Size of OpenImageIO's image cache",
            [](Session&, const Call& call) {
                auto* cache = OIIO::ImageCache::create();
                cache->attribute("max_memory_MB", float(call.integer_argument(0, {0, 1 << 30})));
            }))),
        of_manner(
            of_process(row({"autotile"}, {"SIZE"}, "Tiles of OpenImageIO's image cache (0: none)",
                           [](Session&, const Call& call) {
                               auto* cache = OIIO::ImageCache::create();
                               cache->attribute("autotile", call.integer_argument(0, {0, 1 << 16}));
                           }))),
        row({"metamerge"}, {}, "Results have the metadata of all images they are made of",
            [](Session& session, const Call&) { session.metamerge = true; }),
        of_process(oiioattrib),
        of_manner(row({"warnings-exit"}, {}, "Exit with status 2 when there were warnings",
                      [](Session& session, const Call&) { session.warnings_exit = true; })),
    };
}

} // namespace tonetool::chain
