// SPDX-License-Identifier: BSD-3-Clause
// Commands that print what images are, and other texts.
#include <OpenImageIO/strutil.h>
#include <cstdio>
#include <ostream>

#include "chain/commands/commands.h"
#include "chain/images/inspect.h"
#include "chain/session/expression.h"
#include "chain/session/ops.h"

namespace tonetool::chain {

namespace {

void run_info(Session& session, const Call& call) {
    session.settings.list.info = true;
    session.settings.list.format = call.choice("format", {"text", "xml"}).value_or("");
    session.settings.list.verbose = session.settings.list.verbose || call.flag("verbose", false);
}

void run_dumpdata(Session& session, const Call& call) {
    session.settings.list.dump = call.text("C").value_or("");
    session.settings.list.dump_black = call.flag("empty", true);
}

void print_listing(Session& session, const Call& call, Listing what) {
    what.named = false;
    what.all_subimages = call.flag("allsubimages", session.settings.all_subimages);
    what.metamatch = session.settings.list.metamatch;
    what.no_metamatch = session.settings.list.no_metamatch;
    session.stack.push(call.images[0]);
    try {
        session.out << listing_text(*call.images[0], what);
    } catch (const ReadError& problem) {
        if (!session.settings.compat || !what.stats)
            throw;
        session.error("read", problem.why);
        session.print(OIIO::Strutil::rstrip(header_text(*call.images[0], 0, false)));
        throw CommandError("unable to compute: " + problem.why + "\nError reading from \"" +
                               call.images[0]->name() + "\" (subimg=0, mip=0, tile@0,0,0)",
                           "stats");
    }
    session.outcome.produced = session.outcome.produced_by_name = true;
}

void run_printinfo(Session& session, const Call& call) {
    Listing what;
    what.verbose = call.flag("verbose", true);
    what.stats = call.flag("stats", false);
    const auto format = call.choice("format", {"text", "xml"});
    if (format && session.settings.compat)
        session.warning(call.text(), "format= has no effect here, as in oiiotool");
    else if (call.flag("native", false) && !session.settings.compat)
        what.native = call.images[0]->part().from_file();
    what.format = session.settings.compat ? "" : format.value_or("");
    print_listing(session, call, what);
}

void run_printstats(Session& session, const Call& call) {
    Listing what;
    what.stats = true;
    what.verbose = session.settings.verbose;
    // oiiotool's help says roi=, but oiiotool takes window=.
    if (call.has("roi") && session.settings.compat)
        session.warning(call.text(), "roi= has no effect, as in oiiotool (window= has)");
    auto text = call.text("window");
    text = text || session.settings.compat ? text : call.text("roi");
    if (text) {
        const OIIO::ImageSpec& spec = call.images[0]->part().header();
        OIIO::ROI window = spec.roi();
        try {
            adjust_window(session, call, *text, Geometry::Scalable, window);
            window.chbegin = 0;
            window.chend = spec.nchannels;
            what.roi = window;
        } catch (const CommandError& problem) {
            if (!session.settings.compat)
                throw;
            session.error(call.text(), problem.what()); // then prints all pixels, as oiiotool does
        }
    }
    print_listing(session, call, what);
}

void run_echo(Session& session, const Call& call) {
    int lines = call.integer("newline", {0, 99}).value_or(1);
    session.out << OIIO::Strutil::unescape_chars(call.argument(0))
                << std::string(static_cast<size_t>(lines), '\n') << std::flush;
    session.outcome.produced = session.outcome.produced_by_name = true;
}

void run_list_formats(Session& session, const Call&) {
    session.print(formats_text(session.settings.compat));
    session.outcome.produced = true;
}

const Modifiers kFormat = {{"format", "text|xml", "how it is printed (text)"}};
const Modifiers kAllSubimages = {{"allsubimages", "0|1", "of all subimages and MIP levels (-a)"}};

const Rows kInspectRows = {
    command("info", "Print size, channels and format of every image read after it", run_info)
        .modifier("verbose", "0|1", "with the metadata, as -v does")
        .modifiers(kFormat),
    command("stats", "Print pixel statistics of every image read after it",
            [](Session& session, const Call&) { session.settings.list.stats = true; }),
    command("hash", "Print the SHA-1 of the pixels of every image read after it",
            [](Session& session, const Call&) { session.settings.list.hash = true; }),
    command("dumpdata", "Print all pixel values of every image read after it", run_dumpdata)
        .modifier("empty", "0|1", "also pixels that are all 0 (1)")
        .modifier("C", "NAME", "as an array of C of that name"),
    command("metamatch REGEX", "Print only metadata whose names match",
            [](Session& session, const Call& call) {
                session.settings.list.metamatch = call.argument(0);
            }),
    command("no-metamatch REGEX", "Do not print metadata whose names match",
            [](Session& session, const Call& call) {
                session.settings.list.no_metamatch = call.argument(0);
            }),
    command("echo TEXT", "Print a text", run_echo)
        .modifier("newline", "N", "line ends after it (1)")
        .keeps_header(),
    command("printinfo", "Print information about the current image", run_printinfo)
        .images(1, 1)
        .modifiers(kFormat)
        .modifier("verbose", "0|1", "with the metadata (1)")
        .modifier("stats", "0|1", "and with pixel statistics (0)")
        .modifier("native", "0|1", "the data type of the file, not of the memory (0)")
        .modifiers(kAllSubimages),
    command("printstats", "Print pixel statistics of the current image", run_printstats)
        .images(1, 1)
        .modifier("window", "GEOM", "of that part of it")
        .modifier("roi", "GEOM", "the same")
        .modifiers(kAllSubimages),
    command("list-formats", "List the image formats and their file name extensions",
            run_list_formats),
};

} // namespace

Rows inspect_commands() {
    return kInspectRows;
}

} // namespace tonetool::chain
