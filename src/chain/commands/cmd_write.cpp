// SPDX-License-Identifier: BSD-3-Clause
// Commands that write images.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <filesystem>
#include <map>

#include "chain/commands/commands.h"
#include "chain/session/execute.h"
#include "chain/session/io.h"
#include "chain/session/ops.h"
#include "imagebuf/pixels/oiio_compat.h"

namespace tonetool::chain {

void check_outputs(const Session& session) {
    for (const auto& [name, type] : session.settings.output.type_of_channel) {
        if (session.outcome.matched_channels.count(name) == 0) {
            throw CommandError("-d " + name + "=...: no image written after it has a channel \"" +
                               name + "\"");
        }
    }
}

namespace {

// oiiotool accepts fewer types here than with -d, and ignores unknown ones without a message.
void take_named_type(Session& session, const Call& call, const std::string& name,
                     OutputSettings& settings) {
    if (session.settings.compat && OIIO::TypeDesc(name).basetype == OIIO::TypeDesc::UNKNOWN) {
        session.warning(call.text(), "\"" + name + "\" has no effect here, as in oiiotool");
        return;
    }
    settings.type = parse_data_type(name, session.settings.compat);
    settings.type_of_channel.clear();
}

OutputSettings settings_of(Session& session, const Call& call) {
    OutputSettings settings = session.settings.output;
    if (auto name = call.has("type") ? call.text("type") : call.text("datatype"))
        take_named_type(session, call, *name, settings);
    if (auto bits = call.integer("bits", {1, 32})) {
        if (!settings.type && !session.settings.compat)
            settings.type = NamedType{OIIO::TypeUInt16, 0};
        else if (!settings.type)
            session.warning(call.text(), "bits= has no effect without datatype=, as in oiiotool");
        if (settings.type)
            settings.type->bits = *bits;
    }
    const auto compression = call.text("compression");
    if (compression && session.settings.compat) {
        session.warning(call.text(),
                        "compression= has no effect, as in oiiotool (--compression has)");
    } else if (compression) {
        check_compression(*compression);
        settings.compression = *compression;
    }
    if (auto tile = call.text("tile"))
        settings.set_tile(*tile);
    settings.scanline = call.flag("scanline", settings.scanline);
    settings.dither = call.flag("dither", settings.dither);
    settings.autocrop = call.flag("autocrop", settings.autocrop);
    settings.autotrim = call.flag("autotrim", settings.autotrim);
    settings.format_name = call.text("fileformatname").value_or("");
    settings.planarconfig = call.flag("separate", false) ? "separate"
                            : call.flag("contig", false) ? "contig"
                                                         : settings.planarconfig;
    return settings;
}

// oiiotool puts the data type of the colour space in place of the one of -d.
void take_type_of(const std::string& space, Session& session, const Call& call,
                  const std::string& filename, OutputSettings& settings) {
    int bits = 0;
    const auto implied = color_config(session).getColorSpaceDataType(space, &bits);
    const auto& asked = session.settings.output.type;
    if (implied.basetype == OIIO::TypeDesc::UNKNOWN)
        return;
    if (asked && asked->type != implied) {
        session.warning(call.text(),
                        OIIO::Strutil::fmt::format(
                            "Output filename ({}) colorspace \"{}\" implies {} ({} bits), "
                            "overriding prior request for {}.",
                            filename, space, implied, implied.size() * 8, asked->type));
    }
    settings.type =
        call.has("datatype") || call.has("type") ? settings.type : NamedType{implied, 0};
}

// The only colour space that files of the format can have, or "".
std::string space_of_format(const std::string& filename) {
    static const std::map<std::string, std::string> spaces = {
        {".jpg", "sRGB"},  {".jpeg", "sRGB"},  {".gif", "sRGB"},
        {".webp", "sRGB"}, {".ppm", "Rec709"}, {".pnm", "Rec709"}};
    const auto known = spaces.find(OIIO::Strutil::lower(OIIO::Filesystem::extension(filename)));
    return known == spaces.end() ? "" : known->second;
}

// In formats without alpha the colours are written as they are, over black, and are converted as
// such.
bool keeps_alpha(const std::string& filename, const OutputSettings& settings) {
    const auto writer =
        OIIO::ImageOutput::create(settings.format_name.empty() ? filename : settings.format_name);
    (void)OIIO::geterror();
    return !writer || oiio::format_supports(*writer, "alpha");
}

// Converts to the colour space that the file's name tells, or else its format.
void convert_output(Session& session, const Call& call, const std::string& filename,
                    OutputSettings& settings) {
    const std::string linear = linear_space(session);
    const Part& part = session.stack.top()->part();
    std::string space = oiio::space_of_file(color_config(session), filename);
    if (session.settings.compat && !space.empty())
        take_type_of(space, session, call, filename, settings);
    if (space.empty())
        space = space_of_format(filename);
    if (!space.empty()) {
        convert_current(session, part.header().get_string_attribute("oiio:ColorSpace", linear),
                        space,
                        call.flag("unpremult", session.settings.autocc_unpremult) &&
                            keeps_alpha(filename, settings),
                        true);
    }
}

bool keeps_old(Session& session, const Call& call, const std::string& filename) {
    if (session.settings.no_clobber && OIIO::Filesystem::exists(filename)) {
        session.warning("-" + call.row().names.front(),
                        filename + " already exists, not overwriting.");
        session.outcome.produced |= !session.settings.compat; // the requested output exists
        return true;
    }
    const bool current = session.settings.update && !session.settings.compat &&
                         OIIO::Filesystem::exists(filename) &&
                         OIIO::Filesystem::last_write_time(filename) > session.stack.newest_input;
    session.outcome.produced |= current;
    return current;
}

// What a comparison has made in the place of an image that it was made of, by whatever name.
void refuse_over_compared(const Session& session, const Image& image, const std::string& filename) {
    if (!image.is_result || session.settings.compat)
        return;
    for (const std::string& file : session.stack.files_read) {
        std::error_code none;
        if (std::filesystem::equivalent(file, filename, none))
            throw CommandError("\"" + filename +
                               "\" is read by this line, and what a comparison "
                               "has made would be written over it");
    }
}

void write_one(Session& session, const Call& call, const ImagePtr& image,
               const std::string& filename, const Save& save) {
    session.claim(filename);
    refuse_over_compared(session, *image, filename);
    if (keeps_old(session, call, filename))
        return;
    if (session.settings.verbose) {
        session.out << (session.settings.debug ? "Output: " + filename + "\n" : "");
        session.print("Writing " + filename);
    }
    session.outcome.wrote = image->written = true;
    if (session.settings.dry_run)
        return;
    session.note_format(*image);
    OutputSettings settings = settings_of(session, call);
    session.stack.push(image);
    if (call.flag("autocc", session.settings.autocc))
        convert_output(session, call, filename, settings);
    if (settings.autotrim)
        run_command(session, "trim", {});
    save(session, call, *session.stack.top(), filename, settings);
    session.outcome.wrote = true;
    session.stack.images.pop_back();
}

void save_image(Session& session, const Call& call, const Image& image, const std::string& filename,
                const OutputSettings& settings) {
    write_output(image, filename, settings,
                 session.writer(session.settings.compat ? call.text() : call.row().label()),
                 [&] { session.stack.keep_pixels_of(filename); });
}

} // namespace

void write_to_files(Session& session, const Call& call, const Save& save) {
    if (session.stack.images.empty()) {
        if (!session.settings.compat)
            throw CommandError(session.stack.lacks(1));
        session.warning(call.text(),
                        call.argument(0) + " did not have any current image to output.");
        return;
    }
    if (!session.stack.waiting.empty() && !session.settings.compat) {
        throw CommandError("--" + session.stack.waiting +
                           " still waits for an image, so this would not work on its result");
    }
    session.stack.top()->used = true;
    auto first = call.integer("all", {0, 1e9});
    const std::vector<ImagePtr> all =
        first ? session.stack.images : std::vector<ImagePtr>{session.stack.top()};
    for (size_t i = 0; i < all.size(); ++i) {
        write_one(session, call, all[i],
                  first ? with_number(call.argument(0), *first + int(i)) : call.argument(0), save);
    }
}

Modifiers output_modifiers() {
    return {{"datatype", "TYPE", "data type of this file (" + join(data_type_names(), "|") + ")"},
            {"type", "TYPE", "the same"},
            {"bits", "N", "of each channel"},
            {"compression", "NAME", "compression of this file, name or name:quality"},
            {"all", "N", "write all images of the stack; the file name has a %d, from N on"},
            {"autocc", "0|1", "convert to the colour space that the name tells"},
            {"unpremult", "0|1", "divide by alpha for that"},
            {"autocrop", "0|1", "to the display window where the format has no other"},
            {"autotrim", "0|1", "cut off a black border"},
            {"contig", "0|1", "channels interleaved"},
            {"separate", "0|1", "each channel by itself"},
            {"dither", "0|1", "add dither to 8 bits"},
            {"fileformatname", "NAME", "instead of the one that the extension tells"},
            {"scanline", "0|1", "not in tiles"},
            {"tile", "WxH", "in tiles of this size"}};
}

namespace {

void run_output(Session& session, const Call& call) {
    write_to_files(session, call, save_image);
}

void run_data_type(Session& session, const Call& call) {
    session.settings.output.set_type(call.argument(0), session.settings.compat);
}

void run_compression(Session& session, const Call& call) {
    check_compression(call.argument(0));
    session.settings.output.compression = call.argument(0);
}

} // namespace

Rows write_commands() {
    const std::string types = join(data_type_names(), "|");
    return {
        command("o|output FILENAME", "Write the current image", run_output)
            .images(0, kAnyNumber)
            .modifiers(output_modifiers()),
        command("d TYPE",
                "Data type of the outputs that follow, or CHAN=TYPE of one channel (" + types + ")",
                run_data_type),
        command("compression NAME", "Compression of the outputs that follow, name or name:quality",
                run_compression),
        command("quality N", "Quality of JPEG and the like, 1 to 100",
                [](Session& session, const Call& call) {
                    session.settings.output.quality = call.integer_argument(0, {1, 100});
                }),
        command("scanline", "Outputs are not in tiles",
                [](Session& session, const Call&) { session.settings.output.scanline = true; }),
        command("tile WIDTH HEIGHT", "Outputs are in tiles of this size",
                [](Session& session, const Call& call) {
                    session.settings.output.set_tile(call.argument(0) + "x" + call.argument(1));
                }),
        command("force-tiles", "Has no effect, as in oiiotool (valid: --tile WIDTH HEIGHT)",
                do_nothing),
        command("planarconfig CONFIG", "How channels are stored: contig, separate, default",
                [](Session& session, const Call& call) {
                    check_choice("CONFIG", call.argument(0), {"contig", "separate", "default"});
                    session.settings.output.planarconfig = call.argument(0);
                }),
        command("dither", "Add dither where 8 bits are made of more",
                [](Session& session, const Call&) { session.settings.output.dither = true; }),
        command("adjust-time", "Files get the time of their DateTime",
                [](Session& session, const Call&) { session.settings.output.adjust_time = true; }),
        command("noautocrop", "Do not crop to the display window",
                [](Session& session, const Call&) { session.settings.output.autocrop = false; }),
        command("autotrim", "Cut off a black border where the format can say so",
                [](Session& session, const Call&) { session.settings.output.autotrim = true; }),
        command("history", "Write the command line into the metadata again",
                [](Session& session, const Call&) { session.settings.output.history = true; }),
        command("nosoftwareattrib|no-history", "Do not write the command line into the metadata",
                [](Session& session, const Call&) { session.settings.output.history = false; })
            .keeps_header(),
        command("sansattrib",
                "Leave --attrib and --sattrib out of the command line that is written", do_nothing),
    };
}

} // namespace tonetool::chain
