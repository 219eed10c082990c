// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/output.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <ctime>
#include <deque>

#include "chain/images/fitting.h"
#include "chain/language/values.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "text/error.h"
#include "tonetool/color_tags.h"
#include "tonetool/tonetool.h"

namespace tonetool::chain {

namespace {

using namespace std::string_literals;

struct TypeRow {
    const char* name;
    OIIO::TypeDesc type;
    int bits;
};

const TypeRow kTypeRows[] = {
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

std::unique_ptr<OIIO::ImageOutput> find_writer(const std::string& filename,
                                               const std::string& format_name) {
    auto writer = OIIO::ImageOutput::create(format_name.empty() ? filename : format_name);
    if (!writer) {
        std::string why = OIIO::geterror();
        throw CommandError(why.empty() ? "no format for \"" + filename + "\"" : why);
    }
    return writer;
}

void choose_format(DataFormat& format, const OIIO::ImageSpec& spec, const OutputSettings& asked,
                   const Writer& writer) {
    if (asked.type)
        format = {asked.type->type, {}, asked.type->bits};
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
    if (!history.empty() && history.back() != '\n')
        history += '\n';
    spec.attribute("Exif:ImageHistory", history + line);
}

void set_layout(OIIO::ImageSpec& spec, const OutputSettings& settings,
                const OIIO::ImageOutput& writer, bool lenient) {
    const bool tiles = !settings.scanline && oiio::format_supports(writer, "tiles");
    if (tiles && settings.tile_width > 0) {
        spec.tile_width = settings.tile_width;
        spec.tile_height = settings.tile_height;
        spec.tile_depth = 1;
    } else if (!tiles || lenient) { // oiiotool does not keep tiles
        spec.tile_width = spec.tile_height = spec.tile_depth = 0;
    }
    if (!settings.planarconfig.empty() && settings.planarconfig != "default")
        spec.attribute("planarconfig", settings.planarconfig);
}

// A PNG file's gamma, which its writer knows by the tag alone; and the primaries of a known space.
void state_color(OIIO::ImageSpec& spec, const OIIO::ImageOutput& writer) {
    const double gamma = stated_gamma(spec);
    if (gamma > 0 && spec.find_attribute("oiio:Gamma") && writer.format_name() == "png"s)
        spec.attribute("oiio:ColorSpace", "GammaCorrected" + format_number(gamma));
    if (writer.format_name() == "openexr"s)
        state_chromaticities(spec);
}

OIIO::ImageSpec output_spec(const Outgoing& image, const Writer& from,
                            const OutputSettings& settings, const std::string& filename,
                            const OIIO::ImageOutput& writer) {
    OIIO::ImageSpec spec = image.pixels->spec();
    for (const char* hint : {"oiio:ConstantColor", "oiio:AverageColor", "oiio:SHA-1"})
        spec.erase_attribute(hint); // of the pixels that some texture had
    if (spec.get_string_attribute("tonemap:layer", "-").empty()) // 3.1 complains of empty texts
        spec.erase_attribute("tonemap:layer");
    if (settings.history)
        note_history(spec, from.command_line);
    if (!settings.compression.empty())
        spec.attribute("compression", settings.compression);
    if (settings.quality > 0)
        spec.attribute("CompressionQuality", settings.quality);
    if (settings.dither) {
        int seed = int(OIIO::Strutil::strhash(filename));
        spec.attribute("oiio:dither", seed != 0 ? seed : 1);
    }
    set_layout(spec, settings, writer, from.lenient);
    if (!from.lenient) {
        state_color(spec, writer);
        mark_alpha(spec);
    }
    spec.erase_attribute("oiio:BitsPerSample");
    if (image.format.bits > 0)
        spec.attribute("oiio:BitsPerSample", image.format.bits);
    spec.set_format(image.format.type);
    spec.channelformats = image.format.of_channel;
    if (!from.lenient && writer.format_name() == "pnm"s)
        oiio::order_pnm_rows(spec);
    return spec;
}

void warn_of_encoding(const Warn& warn, const OIIO::ImageSpec& spec,
                      const OIIO::ImageOutput& writer) {
    std::string space = spec.get_string_attribute("oiio:ColorSpace");
    bool linear = space == "lin_rec709" || spec.find_attribute("chromaticities");
    const std::string format = writer.format_name();
    const std::string of_light = format == "openexr" ? "OpenEXR"
                                 : format == "hdr"   ? "Radiance"
                                                     : "";
    if (spec.find_attribute("tonemap:curve") && !linear && !of_light.empty()) {
        warn("the tone mapped values are display-encoded (" + space + "), but " + of_light +
             " is read as linear light (encode=none)");
    }
}

// No writer of OpenImageIO stores these attributes, which some readers set; the pixels are copied
// as they are.
void warn_of_lost(const Warn& warn, const OIIO::ImageSpec& spec, const OIIO::ImageOutput& writer) {
    const std::string kept_by = std::string(writer.format_name()) + " file does not say so";
    if (const double exposure = stated_exposure(spec); exposure != 1) {
        warn("the EXPOSURE of " + format_number(exposure) +
             " is not applied to the pixels, and the " + kept_by);
    }
    const double gamma = spec.find_attribute("oiio:Gamma") ? stated_gamma(spec) : 0;
    if (gamma > 0 && writer.format_name() != "png"s) {
        warn("the gamma of " + format_number(gamma) + " is not applied to the pixels, and the " +
             kept_by);
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
    if (part.format())
        return uniform ? DataFormat{part.format()->type, {}, part.format()->bits} : *part.format();
    const std::string name = part.header().get_string_attribute("oiio:subimagename");
    auto known = m_of_subimage.find(name);
    return !name.empty() && known != m_of_subimage.end()
               ? DataFormat{known->second, {}, 0}
               : widest.value_or(DataFormat{part.header().format, {}, 0});
}

const Strings& data_type_names() {
    static const Strings names = [] {
        Strings all;
        for (const TypeRow& row : kTypeRows)
            all.push_back(row.name);
        return all;
    }();
    return names;
}

NamedType parse_data_type(const std::string& name, bool lenient) {
    for (const TypeRow& row : kTypeRows)
        if (name == row.name && (!lenient || name.front() != 's'))
            return {row.type, row.bits};
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
            if (!lenient)
                throw;
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
    if (name.size() < compression.size() && !parse_number(compression.substr(name.size() + 1)))
        throw CommandError("compression \"" + compression + "\" is not name or name:quality");
}

OIIO::TypeDesc output_type(const Part& part, const OutputSettings& settings, const Writer& writer) {
    DataFormat format = writer.types->of(part, writer.lenient);
    choose_format(format, part.header(), settings, writer);
    for (const OIIO::TypeDesc& type : format.of_channel)
        format.type = OIIO::TypeDesc(OIIO::TypeDesc::basetype_merge(format.type, type));
    return format.type;
}

namespace {

// Data types that OpenImageIO's writer accepts but writes wrongly.
void avoid_broken_type(DataFormat& format, const OIIO::ImageOutput& writer,
                       const OutputSettings& asked, const Writer& from) {
    const std::string name = writer.format_name();
    if (name == "fits" && format.type == OIIO::TypeHalf)
        format = DataFormat{}; // it calls half float, and writes half the bytes
    if (name == "pnm" && format.type == OIIO::TypeHalf && !from.lenient && oiio::kPnmTakesTypes)
        format.type = OIIO::TypeFloat; // it would write the bits of half as integers
    if (name == "pnm" && asked.type && asked.type->type == OIIO::TypeUInt16 &&
        !oiio::kPnmTakesTypes)
        from.warn("PNM files of 16 bits would have their bytes swapped: 8 bits are written");
}

// The MIP levels of a subimage on their way to the file.
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
        if (settings.autocrop && fit_windows(*next.pixels, writer, from.lenient, next.owned))
            next.pixels = &next.owned;
        fit_channels(next, writer, from);
        choose_format(next.format, next.pixels->spec(), settings, from);
        avoid_broken_type(next.format, writer, settings, from);
        ready.push_back({next.pixels, output_spec(next, from, settings, filename, writer),
                         level > 0, settings.format_name, !from.lenient});
        if (levels == 1) // OpenEXR would wait for more levels
            ready.back().spec.erase_attribute("textureformat");
        warn_of_encoding(from.warn, ready.back().spec, writer);
        if (!from.lenient) {
            warn_of_lost(from.warn, next.pixels->spec(), writer);
            warn_of_unseen(from.warn, *next.pixels, ready.back().spec, writer);
        }
    }
    if (part.mip_levels() > 1 && !mipmap && !from.lenient) {
        from.warn("only the largest of " + std::to_string(part.mip_levels()) + " MIP levels of " +
                  image.name() + " is written");
    }
}

// The time in the file's DateTime attribute.
void adjust_time(const OIIO::ImageSpec& spec, const std::string& filename) {
    std::tm taken{};
    const std::string date = spec.get_string_attribute("DateTime");
    if (strptime(date.c_str(), "%Y:%m:%d %H:%M:%S", &taken) != nullptr) {
        taken.tm_isdst = -1;
        OIIO::Filesystem::last_write_time(filename, std::mktime(&taken));
    }
}

} // namespace

const OIIO::ImageBuf& texture_pixels(const OIIO::ImageBuf& image, const std::string& filename,
                                     const OutputSettings& settings, bool lenient,
                                     OIIO::ImageBuf& owned) {
    const bool fitted =
        settings.autocrop &&
        fit_windows(image, *find_writer(filename, settings.format_name), lenient, owned);
    return fitted ? owned : image;
}

void write_output(const Image& image, const std::string& filename, const OutputSettings& settings,
                  const Writer& from, const std::function<void()>& before) {
    auto writer = find_writer(filename, settings.format_name);
    std::deque<Outgoing> outgoing; // a deque keeps addresses valid
    std::vector<OutputImage> ready;
    const size_t count = parts_to_write(from.warn, image, *writer);
    for (size_t i = 0; i < count; ++i)
        prepare_part(image, image.part(i), filename, settings, from, *writer, outgoing, ready);
    before();
    std::string why;
    if (!write_images(ready, filename, why)) {
        const std::string folder = OIIO::Filesystem::parent_path(filename);
        const bool lost = !folder.empty() && !OIIO::Filesystem::is_directory(folder);
        throw CommandError(from.lenient && lost
                               ? "Could not open \"" + filename + "\" (No such file or directory)"
                               : why);
    }
    if (settings.adjust_time)
        adjust_time(ready.front().spec, filename);
}

} // namespace tonetool::chain
