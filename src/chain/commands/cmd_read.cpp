// SPDX-License-Identifier: BSD-3-Clause
// Commands that read images.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "chain/commands/commands.h"
#include "chain/session/execute.h"
#include "chain/session/io.h"
#include "chain/session/ops.h"
#include "imagebuf/pixels/oiio_compat.h"

namespace tonetool::chain {

std::string linear_space(Session& session) {
    const char* name = color_config(session).getColorSpaceNameByRole("linear");
    return name && *name ? name : "Linear";
}

void convert_current(Session& session, const std::string& from, const std::string& to,
                     bool unpremult, bool all_subimages) {
    if (!oiio::same_space(color_config(session), from, to)) {
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
    if (session.settings.compat || session.stack.first_header)
        return session.stack.first_header.value_or(usual);
    for (const std::string& name :
         session.in_all_frames ? session.in_all_frames(session.flow.next - 1) : Strings{})
        if (OIIO::Filesystem::is_regular(name))
            return Image::open(name, session.settings.input)->part().header();
    return usual;
}

ImagePtr open_or_substitute(Session& session, const std::string& filename) {
    const Settings& settings = session.settings;
    const std::string& stand_in = settings.missing_file;
    if (!filename.empty() && filename == session.check.absent) {
        ImagePtr none =
            Image::placeholder(filename, OIIO::ImageSpec(1, 1, 3, OIIO::TypeHalf), false);
        none->absent = true;
        return none;
    }
    const bool exists = OIIO::Filesystem::exists(filename);
    if (settings.compat && !exists && !settings.input.config.extra_attribs.empty())
        throw CommandError("Could not open file \"" + filename + "\"");
    if (exists || (stand_in != "black" && stand_in != "checker"))
        return Image::open(filename, settings.input);
    const std::string missing = "File does not exist: \"" + filename + "\"";
    if (settings.compat)
        session.error("read", missing, false);
    else
        session.warning("read", missing + ", " + stand_in + " instead");
    return Image::placeholder(filename, missing_header(session), stand_in == "checker");
}

// Converts from the colour space that the file's name or its metadata tell to the linear one.
void convert_input(Session& session, const std::string& filename, bool unpremult) {
    std::string space = oiio::space_of_file(color_config(session), filename);
    if (space.empty())
        space = session.stack.top()->part().header().get_string_attribute("oiio:ColorSpace");
    if (!space.empty())
        convert_current(session, space, linear_space(session), unpremult);
}

// Prints what --info, --stats, ... ask for of a file that was just read.
void inspect_if_asked(Session& session, const Image& image) {
    if (session.settings.verbose)
        session.print("Reading " + image.name());
    if (session.settings.listing()) {
        Listing what = session.settings.list;
        what.verbose = session.settings.verbose || what.verbose;
        what.all_subimages = session.settings.all_subimages;
        session.out << listing_text(image, what);
        session.outcome.produced = true;
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
        if (!session.stack.first_header)
            session.stack.first_header = image->part().header();
        session.stack.files_read.push_back(filename);
        session.stack.newest_input =
            std::max(session.stack.newest_input, OIIO::Filesystem::last_write_time(filename));
    }
    session.stack.push(image);
    if (real) {
        warn_as_the_recipe_did(session, *image);
        inspect_if_asked(session, *image);
    }
    if (session.settings.autoorient)
        run_command(session, "reorient", {});
    if (session.settings.autocc)
        convert_input(session, filename, session.settings.autocc_unpremult);
}

void push_file_or_label(Session& session, const std::string& word) {
    auto labelled = session.stack.labels.find(word);
    if (labelled != session.stack.labels.end())
        session.stack.push(labelled->second);
    else
        push_file(session, session.file(word));
}

namespace {

// What one -i prints, restored when it is done.
struct ListForOne {
    Listing& list;
    const Listing before = list;
    ~ListForOne() { list = before; }
};

void run_input(Session& session, const Call& call) {
    Settings& settings = session.settings;
    int level = call.integer("info", {0, 2}).value_or(0);
    const ReadOptions usual = settings.input;
    const bool autocc = settings.autocc, unpremult = settings.autocc_unpremult;
    if (auto type = call.text("type"))
        settings.input.type = parse_data_type(*type, settings.compat).type;
    settings.autocc = call.flag("autocc", autocc);
    settings.autocc_unpremult = call.flag("unpremult", unpremult);
    {
        const ListForOne one{settings.list};
        one.list.info |= level > 0;
        one.list.verbose |= level > 1;
        one.list.format = call.text("infoformat").value_or(one.list.format);
        push_file(session, call.argument(0));
    }
    settings.input = usual;
    settings.autocc = autocc;
    settings.autocc_unpremult = unpremult;
    if (call.flag("now", false))
        session.stack.top()->part().pixels();
    if (auto list = call.text("ch")) {
        const Strings wanted = split(*list, ',');
        const Strings names = session.stack.top()->part().header().channelnames;
        const bool in_order =
            std::search(names.begin(), names.end(), wanted.begin(), wanted.end()) != names.end();
        session.stack.top()->noted = settings.compat && !in_order; // hence float, as oiiotool
        run_command(session, "ch", {*list});
    }
}

void run_iconfig(Session& session, const Call& call) {
    const std::string type = call.text("type").value_or("");
    const std::string& value = call.argument(1);
    OIIO::ImageSpec& config = session.settings.input.config;
    if (!type.empty())
        config.attribute(call.argument(0), OIIO::TypeDesc(type), value);
    else if (auto number = parse_integer(value))
        config.attribute(call.argument(0), *number);
    else
        config.attribute(call.argument(0), value);
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
                        if (!session.settings.compat)
                            check_choice("POLICY", call.argument(0), {"error", "black", "checker"});
                        session.settings.missing_file = call.argument(0);
                    })};
}

} // namespace tonetool::chain
