#include "chain/inspect.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "chain/error.h"
#include "chain/text.h"

namespace tonetool::chain {

namespace {

using OIIO::Strutil::fmt::format;

std::string type_name(OIIO::TypeDesc type, int bits) {
    bool fewer = bits > 0 && bits < static_cast<int>(type.size()) * 8;
    return fewer ? "uint" + std::to_string(bits) : std::string(type.c_str());
}

std::string type_names(const DataFormat& data) {
    Strings names;
    for (OIIO::TypeDesc type : data.of_channel) {
        names.push_back(type.c_str());
    }
    return names.empty() ? type_name(data.type, data.bits) : join(names, "/");
}

std::string head_line(const Image& image) {
    const Part& part = image.part();
    const OIIO::ImageSpec& spec = part.header();
    std::string depth = spec.depth > 1 ? format(" x {:4}", spec.depth) : "";
    return format("{:<20} : {:4} x {:4}{}, {} channel, {}{} {}", image.name(), spec.width,
                  spec.height, depth, spec.nchannels, spec.deep ? "deep " : "",
                  type_names(part.format().value_or(DataFormat{})), image.file_format());
}

char type_letter(OIIO::TypeDesc type) {
    if (type == OIIO::TypeDesc::HALF) {
        return 'h';
    }
    return type.is_floating_point() ? (type == OIIO::TypeDesc::DOUBLE ? 'd' : 'f')
                                    : "uui"[type.size() == 1 ? 0 : (type.size() == 2 ? 1 : 2)];
}

std::string subimages_line(const Image& image) {
    Strings all;
    for (const PartPtr& part : image.parts()) {
        const OIIO::ImageSpec& spec = part->header();
        Strings letters;
        for (int c = 0; c < spec.nchannels; ++c) {
            letters.push_back(std::string(1, type_letter(spec.channelformat(c))));
        }
        all.push_back(format("{}x{} [{}]", spec.width, spec.height, join(letters, ",")));
    }
    return format("    {} subimages: {}\n", image.part_count(), join(all, ", "));
}

std::string mip_line(const Part& part) {
    const OIIO::ImageSpec& spec = part.header();
    std::string line = "    MIP-map levels:";
    for (int level = 0; level < part.mip_levels(); ++level) {
        line +=
            format(" {}x{}", std::max(1, spec.width >> level), std::max(1, spec.height >> level));
    }
    return line + "\n";
}

std::string window_lines(const OIIO::ImageSpec& spec) {
    std::string text;
    if (spec.x != 0 || spec.y != 0 || spec.z != 0) {
        text += format("    pixel data origin: x={}, y={}\n", spec.x, spec.y);
    }
    if (spec.full_x != spec.x || spec.full_y != spec.y || spec.full_width != spec.width ||
        spec.full_height != spec.height) {
        text += format("    full/display size: {} x {}\n", spec.full_width, spec.full_height);
        text += format("    full/display origin: {}, {}\n", spec.full_x, spec.full_y);
    }
    if (spec.tile_width > 0) {
        text += format("    tile size: {} x {}\n", spec.tile_width, spec.tile_height);
    }
    return text;
}

std::string channel_line(const OIIO::ImageSpec& spec) {
    Strings names;
    for (int c = 0; c < spec.nchannels; ++c) {
        const std::string& name = spec.channelnames[static_cast<size_t>(c)];
        bool mixed = !spec.channelformats.empty();
        names.push_back(mixed ? name + " (" + spec.channelformat(c).c_str() + ")" : name);
    }
    return "    channel list: " + join(names, ", ") + "\n";
}

std::string metadata_lines(const OIIO::ImageSpec& spec) {
    OIIO::ParamValueList attributes = spec.extra_attribs;
    attributes.sort(false);
    std::string text;
    for (const OIIO::ParamValue& value : attributes) {
        bool plain = value.type() == OIIO::TypeString;
        text += format("    {}: {}\n", value.name().string(),
                       plain ? "\"" + value.get_string() + "\""
                             : OIIO::ImageSpec::metadata_val(value, true));
    }
    return text;
}

// How the values of a data type are shown: floats as they are, integers in their own range.
struct Scale {
    double maximum = 0; // 0: float

    explicit Scale(const DataFormat& data) {
        if (!data.type.is_floating_point()) {
            int bits = static_cast<int>(data.type.size()) * 8 - (data.type.is_signed() ? 1 : 0);
            maximum = std::exp2(data.bits > 0 ? std::min(data.bits, bits) : bits) - 1;
        }
    }
    std::string whole(float value) const {
        return maximum > 0 ? format("{:.0f}", std::floor(value * maximum + 0.5))
                           : format("{:f}", value);
    }
    std::string fraction(float value) const {
        return maximum > 0 ? format("{:.2f}", value * maximum) : format("{:f}", value);
    }
    std::string note() const { return maximum > 0 ? format(" (of {:.0f})", maximum) : " (float)"; }
};

template <typename Values, typename Show>
std::string stats_line(const char* name, const Values& values, Show show, const std::string& end) {
    Strings words;
    for (const auto& value : values) {
        words.push_back(show(value));
    }
    return std::string("    Stats ") + name + ": " + join(words, " ") + end + "\n";
}

std::string constant_lines(const OIIO::ImageBuf& pixels, const Scale& scale) {
    std::vector<float> color(static_cast<size_t>(pixels.nchannels()));
    bool constant = OIIO::ImageBufAlgo::isConstantColor(pixels, 0.0f, color);
    std::string text = std::string("    Constant: ") + (constant ? "Yes" : "No") + "\n";
    if (constant) {
        Strings words;
        for (float value : color) {
            words.push_back(scale.fraction(value));
        }
        text += "    Constant Color: " + join(words, " ") + scale.note() + "\n";
    }
    bool gray = OIIO::ImageBufAlgo::isMonochrome(pixels);
    return text + "    Monochrome: " + (gray ? "Yes" : "No") + "\n";
}

// MIP-mapped images have their figures two columns further right.
std::string indented(const std::string& text) {
    std::string result;
    for (const std::string& line : split(text.substr(0, text.size() - 1), '\n')) {
        result += "  " + line + "\n";
    }
    return result;
}

} // namespace

std::string info_text(const Image& image, bool verbose) {
    const Part& part = image.part();
    std::string text = head_line(image);
    if (!verbose) {
        text += image.part_count() > 1 ? format(" ({} subimages)", image.part_count()) : "";
        return text + (part.mip_levels() > 1 ? " (+mipmap)" : "") + "\n";
    }
    text += "\n";
    text += image.part_count() > 1 ? subimages_line(image) : "";
    text += part.mip_levels() > 1 ? mip_line(part) : "";
    const OIIO::ImageSpec& spec = part.header();
    return text + channel_line(spec) + window_lines(spec) + metadata_lines(spec);
}

std::string stats_text(const Image& image) {
    Part& part = image.part();
    const OIIO::ImageBuf& pixels = part.pixels();
    if (pixels.deep()) {
        throw CommandError("\"" + image.name() +
                           "\" is deep (valid: images without depth samples)");
    }
    auto stats = OIIO::ImageBufAlgo::computePixelStats(pixels);
    if (stats.min.empty()) {
        throw CommandError("cannot measure \"" + image.name() + "\": " + pixels.geterror());
    }
    Scale scale(part.format().value_or(DataFormat{}));
    auto whole = [&](float value) { return scale.whole(value); };
    auto fraction = [&](float value) { return scale.fraction(value); };
    auto count = [](auto value) { return std::to_string(value); };
    std::string text = stats_line("Min", stats.min, whole, scale.note()) +
                       stats_line("Max", stats.max, whole, scale.note()) +
                       stats_line("Avg", stats.avg, fraction, scale.note()) +
                       stats_line("StdDev", stats.stddev, fraction, scale.note()) +
                       stats_line("NanCount", stats.nancount, count, " ") +
                       stats_line("InfCount", stats.infcount, count, " ") +
                       stats_line("FiniteCount", stats.finitecount, count, " ") +
                       constant_lines(pixels, scale);
    return part.mip_levels() > 1 ? indented(text) : text;
}

void inspect_if_asked(Session& session, const Image& image) {
    if (session.verbose) {
        session.print("Reading " + image.name());
    }
    if (!session.info && !session.stats) {
        return;
    }
    session.out << info_text(image, session.verbose || session.info_verbose);
    if (session.stats) {
        session.out << stats_text(image);
    }
    session.produced = true;
}

} // namespace tonetool::chain
