#include "files/output.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <ctime>
#include <deque>

#include "files/channels.h"
#include "imagebuf/oiio_compat.h"
#include "include/tonetool/tonetool.h"
#include "text/error.h"
#include "text/values.h"

namespace tonetool::files {

namespace {

using namespace std::string_literals;

struct TypeRow {
    const char* name;
    OIIO::TypeDesc type;
    int bits;
};

const TypeRow type_rows[] = {
    {"uint1", OIIO::TypeDesc::UINT8, 1},    {"uint2", OIIO::TypeDesc::UINT8, 2},
    {"uint4", OIIO::TypeDesc::UINT8, 4},    {"uint6", OIIO::TypeDesc::UINT8, 6},
    {"uint8", OIIO::TypeDesc::UINT8, 0},    {"sint8", OIIO::TypeDesc::INT8, 0},
    {"uint10", OIIO::TypeDesc::UINT16, 10}, {"uint12", OIIO::TypeDesc::UINT16, 12},
    {"int8", OIIO::TypeDesc::INT8, 0},      {"int16", OIIO::TypeDesc::INT16, 0},
    {"int32", OIIO::TypeDesc::INT32, 0},    {"uint16", OIIO::TypeDesc::UINT16, 0},
    {"sint16", OIIO::TypeDesc::INT16, 0},   {"uint32", OIIO::TypeDesc::UINT32, 0},
    {"sint32", OIIO::TypeDesc::INT32, 0},   {"half", OIIO::TypeDesc::HALF, 0},
    {"float", OIIO::TypeDesc::FLOAT, 0},    {"double", OIIO::TypeDesc::DOUBLE, 0},
};

// One subimage on its way to the file: pixels (owned here where they had to change), data types.
struct Outgoing {
    OIIO::ImageBuf owned;
    const OIIO::ImageBuf* pixels;
    DataFormat format;
};

std::unique_ptr<OIIO::ImageOutput> find_writer(const std::string& filename,
                                               const std::string& format_name) {
    auto writer = OIIO::ImageOutput::create(format_name.empty() ? filename : format_name);
    if (!writer) {
        std::string why = OIIO::geterror();
        throw CommandError(why.empty() ? "no format for \"" + filename + "\"" : why);
    }
    return writer;
}

// Formats without a data window get the display window; those without a negative origin get the
// part of it that they can hold.
void fit_windows(Outgoing& image, const OIIO::ImageOutput& writer) {
    OIIO::ROI wanted = image.pixels->roi_full();
    bool windows = oiio::format_supports(writer, "displaywindow");
    bool negative = oiio::format_supports(writer, "negativeorigin");
    const OIIO::ImageSpec& spec = image.pixels->spec();
    bool below_zero = std::min({spec.x, spec.y, spec.full_x, spec.full_y}) < 0;
    if (wanted == image.pixels->roi() || spec.deep || (windows && (negative || !below_zero))) {
        return;
    }
    wanted.chbegin = 0;
    wanted.chend = spec.nchannels;
    if (windows) {
        wanted.xbegin = std::max(wanted.xbegin, 0);
        wanted.ybegin = std::max(wanted.ybegin, 0);
    }
    OIIO::ImageBuf fitted = windows ? OIIO::ImageBufAlgo::crop(*image.pixels, wanted)
                                    : OIIO::ImageBufAlgo::cut(*image.pixels, wanted);
    if (fitted.has_error()) {
        throw CommandError(fitted.geterror());
    }
    image.owned = std::move(fitted);
    image.pixels = &image.owned;
}

void fit_channels(const Warn& warn, Outgoing& image, const OIIO::ImageOutput& writer) {
    const OIIO::ImageSpec& spec = image.pixels->spec();
    bool alpha = oiio::format_supports(writer, "alpha");
    bool fits = spec.nchannels <= 3 || (spec.nchannels == 4 && alpha) ||
                (spec.nchannels > 4 && oiio::format_supports(writer, "nchannels"));
    if (fits) {
        return;
    }
    // What was tone mapped is what is to be seen.
    std::string layer = spec.get_string_attribute("tonemap:layer");
    layer += layer.empty() ? "" : ".";
    bool opaque = !layer.empty() && channel_index(spec, layer + "A") < 0;
    int kept = alpha && !opaque ? 4 : 3;
    std::vector<int> chosen;
    Strings names;
    for (int i = 0; i < kept; ++i) {
        static const char* const usual[] = {"R", "G", "B", "A"};
        chosen.push_back(channel_index(spec, layer + usual[i]));
    }
    if (std::find(chosen.begin(), chosen.end(), -1) != chosen.end()) {
        chosen = kept == 4 ? std::vector<int>{0, 1, 2, 3} : std::vector<int>{0, 1, 2};
    }
    for (int index : chosen) {
        names.push_back(spec.channelnames[static_cast<size_t>(index)]);
    }
    warn("Can't save " + std::to_string(spec.nchannels) + " channels to " + writer.format_name() +
         "... saving only " + join(names, ","));
    image.owned = OIIO::ImageBufAlgo::channels(*image.pixels, kept, chosen);
    image.pixels = &image.owned;
    image.format.of_channel.clear();
}

void choose_format(DataFormat& format, const OIIO::ImageSpec& spec, const OutputSettings& asked,
                   const Writer& writer) {
    if (asked.type) {
        format = {asked.type->type, {}, asked.type->bits};
    }
    for (const auto& [name, type] : asked.type_of_channel) {
        for (size_t c = 0; c < spec.channelnames.size(); ++c) {
            if (spec.channelnames[c] == name) {
                format.of_channel.resize(spec.channelnames.size(), format.type);
                format.of_channel[c] = type.type;
                writer.matched->insert(name);
            }
        }
    }
    auto same = [&](OIIO::TypeDesc type) { return type == format.of_channel.front(); };
    if (!format.of_channel.empty() &&
        std::all_of(format.of_channel.begin(), format.of_channel.end(), same)) {
        format.type = format.of_channel.front();
        format.of_channel.clear();
    }
}

void note_history(OIIO::ImageSpec& spec, const std::string& line) {
    spec.attribute("Software", "tonetool " TONETOOL_VERSION " : " + line);
    std::string history = spec.get_string_attribute("Exif:ImageHistory");
    if (!history.empty() && history.back() != '\n') {
        history += '\n';
    }
    spec.attribute("Exif:ImageHistory", history + line);
}

void set_layout(OIIO::ImageSpec& spec, const OutputSettings& settings,
                const OIIO::ImageOutput& writer, bool lenient) {
    const bool tiles = !settings.scanline && oiio::format_supports(writer, "tiles");
    if (tiles && settings.tile_width > 0) {
        spec.tile_width = settings.tile_width;
        spec.tile_height = settings.tile_height;
        spec.tile_depth = 1;
    } else if (!tiles || lenient) { // oiiotool keeps no tiles
        spec.tile_width = spec.tile_height = spec.tile_depth = 0;
    }
    if (!settings.planarconfig.empty() && settings.planarconfig != "default") {
        spec.attribute("planarconfig", settings.planarconfig);
    }
}

OIIO::ImageSpec output_spec(const Outgoing& image, const Writer& from,
                            const OutputSettings& settings, const std::string& filename,
                            const OIIO::ImageOutput& writer) {
    OIIO::ImageSpec spec = image.pixels->spec();
    for (const char* hint : {"oiio:ConstantColor", "oiio:AverageColor", "oiio:SHA-1"}) {
        spec.erase_attribute(hint); // of the pixels that some texture had
    }
    if (settings.history) {
        note_history(spec, from.command_line);
    }
    if (!settings.compression.empty()) {
        spec.attribute("compression", settings.compression);
    }
    if (settings.quality > 0) {
        spec.attribute("CompressionQuality", settings.quality);
    }
    if (settings.dither) {
        int seed = int(OIIO::Strutil::strhash(filename));
        spec.attribute("oiio:dither", seed != 0 ? seed : 1);
    }
    set_layout(spec, settings, writer, from.lenient);
    spec.erase_attribute("oiio:BitsPerSample");
    if (image.format.bits > 0) {
        spec.attribute("oiio:BitsPerSample", image.format.bits);
    }
    spec.set_format(image.format.type);
    spec.channelformats = image.format.of_channel;
    return spec;
}

void warn_of_encoding(const Warn& warn, const OIIO::ImageSpec& spec,
                      const OIIO::ImageOutput& writer) {
    std::string space = spec.get_string_attribute("oiio:ColorSpace");
    bool linear = space == "lin_rec709" || spec.find_attribute("chromaticities");
    if (spec.find_attribute("tonemap:curve") && !linear && writer.format_name() == "openexr"s) {
        warn("the tone mapped values are display-encoded (" + space +
             "), but OpenEXR is read as linear light (encode=none)");
    }
}

size_t parts_to_write(const Warn& warn, const Image& image, const OIIO::ImageOutput& writer) {
    if (image.part_count() > 1 && !oiio::format_supports(writer, "multiimage")) {
        warn(std::string(writer.format_name()) + " holds one image: only the first of " +
             std::to_string(image.part_count()) + " subimages is written");
        return 1;
    }
    return image.part_count();
}

} // namespace

void ReadTypes::note(const Image& image) {
    const DataFormat of_first = image.part().format().value_or(DataFormat{});
    DataFormat now = widest.value_or(DataFormat{of_first.type, {}, of_first.bits});
    for (const PartPtr& part : image.parts()) {
        const OIIO::TypeDesc type = part->format()->type;
        now.type = OIIO::TypeDesc(OIIO::TypeDesc::basetype_merge(now.type, type));
        m_of_subimage.emplace(part->header().get_string_attribute("oiio:subimagename"), type);
    }
    widest = now;
}

DataFormat ReadTypes::of(const Part& part, bool uniform) const {
    if (part.format()) {
        return uniform ? DataFormat{part.format()->type, {}, part.format()->bits} : *part.format();
    }
    const std::string name = part.header().get_string_attribute("oiio:subimagename");
    auto known = m_of_subimage.find(name);
    return !name.empty() && known != m_of_subimage.end()
               ? DataFormat{known->second, {}, 0}
               : widest.value_or(DataFormat{part.header().format, {}, 0});
}

const Strings& data_type_names() {
    static const Strings names = [] {
        Strings all;
        for (const TypeRow& row : type_rows) {
            all.push_back(row.name);
        }
        return all;
    }();
    return names;
}

NamedType parse_data_type(const std::string& name, bool lenient) {
    for (const TypeRow& row : type_rows) {
        if (name == row.name && (!lenient || name.front() != 's')) {
            return {row.type, row.bits};
        }
    }
    const std::string valid = " (valid: " + join(data_type_names(), ", ") + ")";
    throw CommandError("Unknown data format \"" + name + "\"" + (lenient ? "" : valid));
}

void OutputSettings::set_type(const std::string& text, bool lenient) {
    if (text.find('=') == std::string::npos) {
        type = parse_data_type(text, lenient);
        type_of_channel.clear();
        return;
    }
    for (const std::string& word : split(text, ',')) {
        const size_t equals = word.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw CommandError("Malformed format designator \"" + word +
                               "\" (valid: TYPE or CHANNEL=TYPE)");
        }
        try {
            type_of_channel[word.substr(0, equals)] =
                parse_data_type(word.substr(equals + 1), lenient);
        } catch (const CommandError&) {
            if (!lenient) {
                throw;
            }
        }
    }
}

void OutputSettings::set_tile(const std::string& text) {
    const Strings words = split(text, 'x');
    tile_width = checked_integer("tile", words.front(), {0, 1 << 16});
    tile_height = checked_integer("tile", words.back(), {0, 1 << 16});
    scanline = false;
}

void check_compression(const std::string& compression) {
    static const Strings known = {
        "none", "rle",  "zip",  "zips",     "piz",       "pxr24",    "b44",    "b44a",
        "dwaa", "dwab", "lzw",  "deflate",  "packbits",  "ccittrle", "jpeg",   "ccittfax3",
        "zfp",  "gzip", "webp", "lossless", "pngfilter", "htj2k256", "htj2k32"};
    std::string name = compression.substr(0, compression.find(':'));
    if (std::find(known.begin(), known.end(), name) == known.end()) {
        throw CommandError("unknown compression \"" + compression +
                           "\" (valid: " + join(known, ", ") + ")");
    }
    if (name.size() < compression.size() && !parse_number(compression.substr(name.size() + 1))) {
        throw CommandError("compression \"" + compression + "\" is not name or name:quality");
    }
}

OIIO::TypeDesc output_type(const Part& part, const OutputSettings& settings, const Writer& writer) {
    DataFormat format = writer.types->of(part, writer.lenient);
    choose_format(format, part.header(), settings, writer);
    for (const OIIO::TypeDesc& type : format.of_channel) {
        format.type = OIIO::TypeDesc(OIIO::TypeDesc::basetype_merge(format.type, type));
    }
    return format.type;
}

namespace {

// The levels of a part on their way to the file.
void prepare_part(const Image& image, Part& part, const std::string& filename,
                  const OutputSettings& settings, const Writer& from,
                  const OIIO::ImageOutput& writer, std::deque<Outgoing>& outgoing,
                  std::vector<OutputImage>& ready) {
    const bool mipmap = oiio::format_supports(writer, "mipmap");
    const int levels = mipmap ? part.mip_levels() : 1;
    for (int level = 0; level < levels; ++level) {
        Outgoing& next = outgoing.emplace_back();
        next.pixels = &part.pixels(level);
        next.format = from.types->of(part, from.lenient);
        if (settings.autocrop) {
            fit_windows(next, writer);
        }
        fit_channels(from.warn, next, writer);
        choose_format(next.format, next.pixels->spec(), settings, from);
        ready.push_back({next.pixels, output_spec(next, from, settings, filename, writer),
                         level > 0, settings.format_name});
        if (levels == 1) { // OpenEXR would wait for more
            ready.back().spec.erase_attribute("textureformat");
        }
        warn_of_encoding(from.warn, ready.back().spec, writer);
    }
    if (part.mip_levels() > 1 && !mipmap && !from.lenient) {
        from.warn("only the largest of " + std::to_string(part.mip_levels()) + " MIP levels of " +
                  image.name() + " is written");
    }
}

// The time that the file's DateTime tells.
void adjust_time(const OIIO::ImageSpec& spec, const std::string& filename) {
    std::tm taken{};
    const std::string date = spec.get_string_attribute("DateTime");
    if (strptime(date.c_str(), "%Y:%m:%d %H:%M:%S", &taken) != nullptr) {
        taken.tm_isdst = -1;
        OIIO::Filesystem::last_write_time(filename, std::mktime(&taken));
    }
}

} // namespace

void write_output(const Image& image, const std::string& filename, const OutputSettings& settings,
                  const Writer& from, const std::function<void()>& before) {
    auto writer = find_writer(filename, settings.format_name);
    std::deque<Outgoing> outgoing; // addresses stay
    std::vector<OutputImage> ready;
    const size_t count = parts_to_write(from.warn, image, *writer);
    for (size_t i = 0; i < count; ++i) {
        prepare_part(image, image.part(i), filename, settings, from, *writer, outgoing, ready);
    }
    before();
    std::string why;
    if (!write_images(ready, filename, why)) {
        const std::string folder = OIIO::Filesystem::parent_path(filename);
        const bool lost = !folder.empty() && !OIIO::Filesystem::is_directory(folder);
        throw CommandError(from.lenient && lost
                               ? "Could not open \"" + filename + "\" (No such file or directory)"
                               : why);
    }
    if (settings.adjust_time) {
        adjust_time(ready.front().spec, filename);
    }
}

} // namespace tonetool::files
