// Commands that read and write images.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cstdio>

#include "chain/error.h"
#include "chain/frames.h"
#include "chain/inspect.h"
#include "chain/io.h"
#include "chain/ops.h"
#include "chain/output.h"
#include "chain/runner.h"

namespace tonetool::chain {

namespace {

// Of the same file in another frame, or of the first image that was read.
OIIO::ImageSpec missing_header(const Session& session) {
    const OIIO::ImageSpec usual(1920, 1080, 4, OIIO::TypeHalf);
    if (session.compat || session.first_header) {
        return session.first_header.value_or(usual);
    }
    for (const FrameRun& run : session.plan ? session.plan->runs : std::vector<FrameRun>{}) {
        const std::string& name = run.words.at(session.flow.next - 1);
        if (OIIO::Filesystem::is_regular(name)) {
            return Image::open(name, session.input)->part().header();
        }
    }
    return usual;
}

// What --missingfile puts in the place of a file that is not there.
ImagePtr substitute(Session& session, const std::string& filename) {
    OIIO::ImageSpec spec = missing_header(session);
    const DataFormat format{spec.format, {}, 0};
    spec.set_format(OIIO::TypeFloat);
    spec.extra_attribs.clear();
    OIIO::ImageBuf pixels(spec);
    std::vector<float> black(size_t(spec.nchannels), 0.0f);
    const std::vector<float> white(black.size(), 1.0f);
    if (spec.alpha_channel >= 0) { // only the checker's
        black[size_t(spec.alpha_channel)] = 1;
    }
    session.missing_file == "black" ? OIIO::ImageBufAlgo::zero(pixels)
                                    : OIIO::ImageBufAlgo::checker(pixels, 64, 64, 1, black, white);
    return Image::created(filename, std::move(pixels), format);
}

ImagePtr open_or_substitute(Session& session, const std::string& filename) {
    const bool exists = OIIO::Filesystem::exists(filename);
    if (session.compat && !exists && !session.input.config.extra_attribs.empty()) {
        throw CommandError("Could not open file \"" + filename + "\"");
    }
    if (exists || (session.missing_file != "black" && session.missing_file != "checker")) {
        return Image::open(filename, session.input);
    }
    const std::string missing = "File does not exist: \"" + filename + "\"";
    if (session.compat) {
        session.error("read", missing, false);
    } else {
        session.warning("read", missing + ", " + session.missing_file + " instead");
    }
    return substitute(session, filename);
}

std::string linear_space(Session& session) {
    const char* name = color_config(session).getColorSpaceNameByRole("linear");
    return name && *name ? name : "Linear";
}

void convert(Session& session, const std::string& from, const std::string& to, bool unpremult) {
    if (!OIIO::Strutil::iequals(from, to)) {
        run_command(session,
                    unpremult ? "colorconvert:strict=0:unpremult=1" : "colorconvert:strict=0",
                    {from, to});
    }
}

// From the colour space that the file's name or its metadata tell to the linear one.
void convert_input(Session& session, const std::string& filename, bool unpremult) {
    std::string space = color_config(session).getColorSpaceFromFilepath(filename);
    if (space.empty()) {
        space = session.stack.back()->part().header().get_string_attribute("oiio:ColorSpace");
    }
    if (!space.empty()) {
        convert(session, space, linear_space(session), unpremult);
    }
}

} // namespace

void push_file(Session& session, const std::string& filename) {
    ImagePtr image = open_or_substitute(session, filename);
    bool real = image->part().from_file();
    if (real) {
        if (!session.first_header) {
            session.first_header = image->part().header();
        }
        session.newest_input =
            std::max(session.newest_input, OIIO::Filesystem::last_write_time(filename));
    }
    session.push(image);
    if (real) {
        inspect_if_asked(session, *image);
    }
    if (session.autoorient) {
        run_command(session, "reorient", {});
    }
    if (session.autocc) {
        convert_input(session, filename, session.autocc_unpremult);
    }
}

void push_file_or_label(Session& session, const std::string& word) {
    auto labelled = session.labels.find(word);
    if (labelled != session.labels.end()) {
        session.push(labelled->second);
    } else {
        push_file(session, session.file(word));
    }
}

void check_outputs(const Session& session) {
    for (const auto& [name, type] : session.output.type_of_channel) {
        if (session.output.matched_channels.count(name) == 0) {
            throw CommandError("-d " + name + "=...: no image written after it has a channel \"" +
                               name + "\"");
        }
    }
}

namespace {

// Settings of one -i, put back when it is done.
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
    if (auto type = call.text("type")) {
        session.input.type = parse_data_type(session, *type).type;
    }
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
    if (call.flag("now", false)) {
        session.stack.back()->part().pixels();
    }
    if (auto list = call.text("ch")) {
        const Strings wanted = split(*list, ',');
        const Strings names = session.stack.back()->part().header().channelnames;
        const bool in_order =
            std::search(names.begin(), names.end(), wanted.begin(), wanted.end()) != names.end();
        session.stack.back()->noted = session.compat && !in_order; // so float, as oiiotool
        run_command(session, "ch", {*list});
    }
}

void set_tile(OutputSettings& settings, const std::string& text) {
    const Strings words = split(text, 'x');
    settings.tile_width = checked_integer("tile", words.front(), {0, 1 << 16});
    settings.tile_height = checked_integer("tile", words.back(), {0, 1 << 16});
    settings.scanline = false;
}

OutputSettings settings_of(const Session& session, const Call& call) {
    OutputSettings settings = session.output;
    if (auto name = call.text("datatype")) {
        settings.type = parse_data_type(session, *name);
        settings.type_of_channel.clear();
    }
    if (auto bits = call.integer("bits", {1, 32})) {
        if (!settings.type && !session.compat) { // oiiotool takes no notice of it then
            settings.type = NamedType{OIIO::TypeUInt16, 0};
        }
        if (settings.type) {
            settings.type->bits = *bits;
        }
    }
    if (auto compression = call.text("compression"); compression && !session.compat) {
        check_compression(*compression);
        settings.compression = *compression;
    }
    if (auto tile = call.text("tile")) {
        set_tile(settings, *tile);
    }
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

// A printf pattern with exactly one %d or %0Nd, filled in.
std::string numbered_name(const std::string& pattern, int number) {
    size_t percent = pattern.find('%');
    size_t end = percent == std::string::npos
                     ? percent
                     : pattern.find_first_not_of("0123456789", percent + 1);
    bool valid = end != std::string::npos && pattern[end] == 'd' && end - percent < 4 &&
                 pattern.find('%', end) == std::string::npos;
    if (!valid) {
        throw CommandError("all= needs one %d in the file name (\"" + pattern +
                           "\"; valid: out.%d.exr, out.%04d.exr)");
    }
    std::string width = pattern.substr(percent + 1, end - percent - 1);
    std::string digits = std::to_string(number);
    size_t wanted = width.empty() ? 0 : std::stoul(width);
    char pad = !width.empty() && width[0] == '0' ? '0' : ' ';
    digits.insert(0, wanted > digits.size() ? wanted - digits.size() : 0, pad);
    return pattern.substr(0, percent) + digits + pattern.substr(end + 1);
}

// oiiotool puts the data type of the colour space in place of the one of -d.
void take_type_of(const std::string& space, Session& session, const Call& call,
                  const std::string& filename, OutputSettings& settings) {
    int bits = 0;
    const auto implied = color_config(session).getColorSpaceDataType(space, &bits);
    const auto& asked = session.output.type;
    if (implied.basetype == OIIO::TypeDesc::UNKNOWN) {
        return;
    }
    if (asked && asked->type != implied) {
        session.warning(call.text(),
                        OIIO::Strutil::fmt::format(
                            "Output filename ({}) colorspace \"{}\" implies {} ({} bits), "
                            "overriding prior request for {}.",
                            filename, space, implied, implied.size() * 8, asked->type));
    }
    settings.type = call.has("datatype") ? settings.type : NamedType{implied, 0};
}

// The colour space that the file's name tells; else sRGB for 8 bits and the linear one for more.
void convert_output(Session& session, const Call& call, const std::string& filename,
                    OutputSettings& settings) {
    const std::string linear = linear_space(session);
    const Part& part = session.stack.back()->part();
    std::string space = color_config(session).getColorSpaceFromFilepath(filename);
    if (session.compat && !space.empty()) {
        take_type_of(space, session, call, filename, settings);
    }
    if (space.empty()) {
        OIIO::TypeDesc type = settings.type ? settings.type->type : part.header().format;
        const std::string extension = OIIO::Strutil::lower(OIIO::Filesystem::extension(filename));
        bool bytes = type == OIIO::TypeUInt8 || extension == ".jpg" || extension == ".gif" ||
                     extension == ".webp";
        space = bytes ? "sRGB" : linear;
    }
    convert(session, part.header().get_string_attribute("oiio:ColorSpace", linear), space,
            call.flag("unpremult", false));
}

bool keeps_old(Session& session, const std::string& filename) {
    if (session.no_clobber && OIIO::Filesystem::exists(filename)) {
        session.warning("-o", filename + " already exists, not overwriting.");
        return true;
    }
    return session.update && !session.compat && OIIO::Filesystem::exists(filename) &&
           OIIO::Filesystem::last_write_time(filename) > session.newest_input;
}

void write_one(Session& session, const Call& call, const ImagePtr& image,
               const std::string& filename) {
    if (keeps_old(session, filename)) {
        return;
    }
    if (session.verbose) {
        session.out << (session.debug ? "Output: " + filename + "\n" : "");
        session.print("Writing " + filename);
    }
    session.wrote = image->written = true;
    if (session.dry_run) {
        return;
    }
    session.note_format(*image);
    OutputSettings settings = settings_of(session, call);
    session.push(image);
    if (call.flag("autocc", session.autocc)) {
        convert_output(session, call, filename, settings);
    }
    if (settings.autotrim) {
        run_command(session, "trim", {});
    }
    write_output(session, call.row().label(), *session.stack.back(), filename, settings);
    session.stack.pop_back();
}

void run_output(Session& session, const Call& call) {
    if (session.stack.empty()) {
        if (!session.compat) {
            throw CommandError("needs 1 image(s), the stack has 0");
        }
        session.warning(call.text(),
                        call.argument(0) + " did not have any current image to output.");
        return;
    }
    if (!session.waiting.empty() && !session.compat) {
        throw CommandError("--" + session.waiting +
                           " still waits for an image, so this would not work on its result");
    }
    session.stack.back()->used = true;
    auto first = call.integer("all", {0, 1e9});
    const std::vector<ImagePtr> all =
        first ? session.stack : std::vector<ImagePtr>{session.stack.back()};
    for (size_t i = 0; i < all.size(); ++i) {
        write_one(session, call, all[i],
                  first ? numbered_name(call.argument(0), *first + int(i)) : call.argument(0));
    }
}

void run_iconfig(Session& session, const Call& call) {
    const std::string type = call.text("type").value_or("");
    const std::string& value = call.argument(1);
    if (!type.empty()) {
        session.input.config.attribute(call.argument(0), OIIO::TypeDesc(type), value);
    } else if (auto number = parse_integer(value)) {
        session.input.config.attribute(call.argument(0), *number);
    } else {
        session.input.config.attribute(call.argument(0), value);
    }
}

void run_data_type(Session& session, const Call& call) {
    OutputSettings& output = session.output;
    const std::string& text = call.argument(0);
    if (text.find('=') == std::string::npos) {
        output.type = parse_data_type(session, text);
        output.type_of_channel.clear();
        return;
    }
    for (const std::string& word : split(text, ',')) {
        size_t equals = word.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw CommandError("Malformed format designator \"" + word +
                               "\" (valid: TYPE or CHANNEL=TYPE)");
        }
        const std::string type = word.substr(equals + 1);
        try {
            output.type_of_channel[word.substr(0, equals)] = parse_data_type(session, type);
        } catch (const CommandError&) {
            if (!session.compat) {
                throw;
            }
        }
    }
}

void run_compression(Session& session, const Call& call) {
    check_compression(call.argument(0));
    session.output.compression = call.argument(0);
}

std::vector<Command> input_rows() {
    return {
        free_row(Group::Read, "i FILENAME", 0, any_number,
                 "Read an image (as a bare file name does)", run_input,
                 "ch=CHANLIST: keep these channels only, as --ch\n"
                 "info=0|1|2: print information about the file; 2: with its metadata\n"
                 "infoformat=text|xml: how that is printed\n"
                 "autocc=0|1: convert to the linear space from the one that the name tells\n"
                 "unpremult=0|1: divide by alpha for that\n"
                 "now=0|1: read the pixels at once\n"
                 "type=TYPE: data type of the pixels in memory"),
        free_row(Group::Read, "iconfig NAME VALUE", 0, 0, "Set an option of the file reader",
                 run_iconfig, "type=TYPE: its data type"),
        free_row(Group::Read, "missingfile POLICY", 0, 0,
                 "What a file that is not there becomes: error, black or checker",
                 [](Session& session, const Call& call) {
                     if (!session.compat) {
                         check_choice("POLICY", call.argument(0), {"error", "black", "checker"});
                     }
                     session.missing_file = call.argument(0);
                 }),
    };
}

Command output_row() {
    const std::string types = join(data_type_names(), "|");
    return free_row(Group::Write, "o FILENAME", 0, any_number, "Write the current image",
                    run_output,
                    "datatype=TYPE: data type of this file (" + types + ")\n" +
                        "bits=N: of each channel\n"
                        "compression=NAME: compression of this file, name or name:quality\n"
                        "all=N: write all images of the stack; the file name has a %d, from N on\n"
                        "autocc=0|1: convert to the colour space that the name tells\n"
                        "unpremult=0|1: divide by alpha for that\n"
                        "autocrop=0|1: to the display window where the format has no other\n"
                        "autotrim=0|1: cut off a black border\n"
                        "contig=0|1: channels interleaved\n"
                        "separate=0|1: each channel by itself\n"
                        "dither=0|1: add dither to 8 bits\n"
                        "fileformatname=NAME: instead of the one that the extension tells\n"
                        "scanline=0|1: not in tiles\n"
                        "tile=WxH: in tiles of this size");
}

// What holds for the outputs that follow.
std::vector<Command> output_setting_rows() {
    const std::string types = join(data_type_names(), "|");
    const auto set = [](const char* usage, const std::string& help, Run run) {
        return free_row(Group::Write, usage, 0, 0, help, std::move(run));
    };
    return {
        set("d TYPE",
            "Data type of the outputs that follow, or CHAN=TYPE of one channel (" + types + ")",
            run_data_type),
        set("compression NAME", "Compression of the outputs that follow, name or name:quality",
            run_compression),
        set("quality N", "Quality of JPEG and the like, 1 to 100",
            [](Session& session, const Call& call) {
                session.output.quality = call.integer_argument(0, {1, 100});
            }),
        set("scanline", "Outputs are not in tiles",
            [](Session& session, const Call&) { session.output.scanline = true; }),
        set("tile WIDTH HEIGHT", "Outputs are in tiles of this size",
            [](Session& session, const Call& call) {
                set_tile(session.output, call.argument(0) + "x" + call.argument(1));
            }),
        set("planarconfig CONFIG", "How channels are stored: contig, separate, default",
            [](Session& session, const Call& call) {
                check_choice("CONFIG", call.argument(0), {"contig", "separate", "default"});
                session.output.planarconfig = call.argument(0);
            }),
        set("dither", "Add dither where 8 bits are made of more",
            [](Session& session, const Call&) { session.output.dither = true; }),
        set("adjust-time", "Files get the time of their DateTime",
            [](Session& session, const Call&) { session.output.adjust_time = true; }),
        set("noautocrop", "Do not crop to the display window",
            [](Session& session, const Call&) { session.output.autocrop = false; }),
        set("autotrim", "Cut off a black border where the format can say so",
            [](Session& session, const Call&) { session.output.autotrim = true; }),
        set("nosoftwareattrib", "Do not write the command line into the metadata",
            [](Session& session, const Call&) { session.output.history = false; }),
        set("sansattrib", "Leave --attrib and --sattrib out of the command line that is written",
            [](Session&, const Call&) {}),
    };
}

} // namespace

std::vector<Command> io_commands() {
    std::vector<Command> rows = input_rows();
    rows.push_back(output_row());
    append(rows, output_setting_rows());
    append(rows, texture_commands());
    return rows;
}

} // namespace tonetool::chain
