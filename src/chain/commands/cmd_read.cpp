// SPDX-License-Identifier: BSD-3-Clause
// Commands that read images.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "chain/commands/commands.h"
#include "chain/session/execute.h"
#include "chain/session/io.h"
#include "chain/session/ops.h"
#include "text/error.h"

namespace tonetool::chain {

std::string linear_space(Session& session) {
    const char* name = color_config(session).getColorSpaceNameByRole("linear");
    return name && *name ? name : "Linear";
}

void convert_current(Session& session, const std::string& from, const std::string& to,
                     bool unpremult, bool all_subimages) {
    if (!OIIO::Strutil::iequals(from, to)) {
        run_command(session,
                    std::string("colorconvert:strict=0") +
                        (all_subimages ? ":allsubimages=1" : "") +
                        (unpremult ? ":unpremult=1" : ""),
                    {from, to});
    }
}

namespace {

// The header of the same file in another frame, or of the first image that was read.
OIIO::ImageSpec missing_header(const Session& session) {
    OIIO::ImageSpec usual(1920, 1080, 4, OIIO::TypeHalf);
    if (session.compat || session.first_header)
        return session.first_header.value_or(usual);
    for (const std::string& name :
         session.in_all_frames ? session.in_all_frames(session.flow.next - 1) : Strings{})
        if (OIIO::Filesystem::is_regular(name))
            return Image::open(name, session.input)->part().header();
    return usual;
}

ImagePtr open_or_substitute(Session& session, const std::string& filename) {
    const bool exists = OIIO::Filesystem::exists(filename);
    if (session.compat && !exists && !session.input.config.extra_attribs.empty())
        throw CommandError("Could not open file \"" + filename + "\"");
    if (exists || (session.missing_file != "black" && session.missing_file != "checker"))
        return Image::open(filename, session.input);
    const std::string missing = "File does not exist: \"" + filename + "\"";
    if (session.compat)
        session.error("read", missing, false);
    else
        session.warning("read", missing + ", " + session.missing_file + " instead");
    return Image::placeholder(filename, missing_header(session), session.missing_file == "checker");
}

// Converts from the colour space that the file's name or its metadata tell to the linear one.
void convert_input(Session& session, const std::string& filename, bool unpremult) {
    std::string space = color_config(session).getColorSpaceFromFilepath(filename);
    if (space.empty())
        space = session.stack.back()->part().header().get_string_attribute("oiio:ColorSpace");
    if (!space.empty())
        convert_current(session, space, linear_space(session), unpremult);
}

// Prints what --info, --stats, ... ask for of a file that was just read.
void inspect_if_asked(Session& session, const Image& image) {
    if (session.verbose)
        session.print("Reading " + image.name());
    if (session.listing()) {
        Listing what = session.list;
        what.verbose = session.verbose || what.verbose;
        what.all_subimages = session.all_subimages;
        session.out << listing_text(image, what);
        session.produced = true;
    }
}

// The warnings of a recipe's run are in its header. They are repeated here once and not in images
// that are made from it.
void warn_as_the_recipe_did(Session& session, const Image& image) {
    const std::string said = image.part().header().get_string_attribute("tone:warnings");
    if (!said.empty() && image.file_format() == "tone")
        session.warning("read", "\"" + image.name() + "\": " + said);
}

} // namespace

void push_file(Session& session, const std::string& filename) {
    ImagePtr image = open_or_substitute(session, filename);
    bool real = image->part().from_file();
    if (real) {
        if (!session.first_header)
            session.first_header = image->part().header();
        session.newest_input =
            std::max(session.newest_input, OIIO::Filesystem::last_write_time(filename));
    }
    session.push(image);
    if (real) {
        warn_as_the_recipe_did(session, *image);
        inspect_if_asked(session, *image);
    }
    if (session.autoorient)
        run_command(session, "reorient", {});
    if (session.autocc)
        convert_input(session, filename, session.autocc_unpremult);
}

void push_file_or_label(Session& session, const std::string& word) {
    auto labelled = session.labels.find(word);
    if (labelled != session.labels.end())
        session.push(labelled->second);
    else
        push_file(session, session.file(word));
}

namespace {

// Settings of one -i, restored when it is done.
struct InfoForOne {
    InfoForOne(Session& the_session, int level) : session(the_session), before(session.list) {
        session.list.info = session.list.info || level > 0;
        session.list.verbose = session.list.verbose || level > 1;
    }
    ~InfoForOne() { session.list = before; }
    Session& session;
    Listing before;
};

void run_input(Session& session, const Call& call) {
    int level = call.integer("info", {0, 2}).value_or(0);
    const ReadOptions usual = session.input;
    const bool autocc = session.autocc, unpremult = session.autocc_unpremult;
    if (auto type = call.text("type"))
        session.input.type = parse_data_type(*type, session.compat).type;
    session.autocc = call.flag("autocc", autocc);
    session.autocc_unpremult = call.flag("unpremult", unpremult);
    {
        InfoForOne settings(session, level);
        session.list.format = call.text("infoformat").value_or(session.list.format);
        push_file(session, call.argument(0));
    }
    session.input = usual;
    session.autocc = autocc;
    session.autocc_unpremult = unpremult;
    if (call.flag("now", false))
        session.stack.back()->part().pixels();
    if (auto list = call.text("ch")) {
        const Strings wanted = split(*list, ',');
        const Strings names = session.stack.back()->part().header().channelnames;
        const bool in_order =
            std::search(names.begin(), names.end(), wanted.begin(), wanted.end()) != names.end();
        session.stack.back()->noted = session.compat && !in_order; // hence float, as oiiotool
        run_command(session, "ch", {*list});
    }
}

void run_iconfig(Session& session, const Call& call) {
    const std::string type = call.text("type").value_or("");
    const std::string& value = call.argument(1);
    if (!type.empty())
        session.input.config.attribute(call.argument(0), OIIO::TypeDesc(type), value);
    else if (auto number = parse_integer(value))
        session.input.config.attribute(call.argument(0), *number);
    else
        session.input.config.attribute(call.argument(0), value);
}

} // namespace

Rows read_commands() {
    return {command("i FILENAME", "Read an image (as a bare file name does)", run_input)
                .images(0, kAnyNumber)
                .modifier("ch", "CHANLIST", "keep these channels only, as --ch")
                .modifier("info", "0|1|2", "print information about the file; 2: with its metadata")
                .modifier("infoformat", "text|xml", "how that is printed")
                .modifier("autocc", "0|1",
                          "convert to the linear space from the one that the name tells")
                .modifier("unpremult", "0|1", "divide by alpha for that")
                .modifier("now", "0|1", "read the pixels at once")
                .modifier("type", "TYPE", "data type of the pixels in memory"),
            command("iconfig NAME VALUE", "Set an option of the file reader", run_iconfig)
                .modifier("type", "TYPE", "its data type"),
            command("missingfile POLICY",
                    "What a file that is not there becomes: error, black or checker",
                    [](Session& session, const Call& call) {
                        if (!session.compat)
                            check_choice("POLICY", call.argument(0), {"error", "black", "checker"});
                        session.missing_file = call.argument(0);
                    })};
}

} // namespace tonetool::chain
