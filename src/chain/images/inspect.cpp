// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/inspect.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <ostream>
#include <regex>

#include "imagebuf/pixels/float_rows.h"
#include "text/error.h"
#include "text/text.h"

namespace tonetool::chain {

namespace {

using OIIO::Strutil::fmt::format;

char type_letter(OIIO::TypeDesc type) {
    if (type == OIIO::TypeDesc::HALF)
        return 'h';
    return type.is_floating_point() ? (type == OIIO::TypeDesc::DOUBLE ? 'd' : 'f')
                                    : "uui"[type.size() == 1 ? 0 : (type.size() == 2 ? 1 : 2)];
}

std::string subimages_line(const Image& image) {
    Strings all;
    for (const PartPtr& part : image.parts()) {
        const OIIO::ImageSpec& spec = part->header();
        Strings letters;
        for (int c = 0; c < spec.nchannels; ++c)
            letters.push_back(std::string(1, type_letter(spec.channelformat(c))));
        all.push_back(format("{}x{} [{}]", spec.width, spec.height, join(letters, ",")));
    }
    return format("    {} subimages: {}\n", image.part_count(), join(all, ", "));
}

std::string mip_line(const Part& part) {
    std::string line = "    MIP-map levels:";
    for (int level = 0; level < part.mip_levels(); ++level)
        line += format(" {}x{}", part.header(level).width, part.header(level).height);
    return line + "\n";
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
std::string shown(const Values& values, Show show, const char* between = " ") {
    Strings words;
    for (const auto& value : values)
        words.push_back(show(value));
    return join(words, between);
}

std::string constant_lines(const OIIO::ImageBuf& pixels, const Scale& scale,
                           const std::string& indent) {
    std::vector<float> color(static_cast<size_t>(pixels.nchannels()));
    bool constant = OIIO::ImageBufAlgo::isConstantColor(pixels, 0.0f, color);
    std::string text = indent + "Constant: " + (constant ? "Yes" : "No") + "\n";
    if (constant) {
        auto fraction = [&](float value) { return scale.fraction(value); };
        text += indent + "Constant Color: " + shown(color, fraction) + scale.note() + "\n";
    }
    bool gray = OIIO::ImageBufAlgo::isMonochrome(pixels);
    return text + indent + "Monochrome: " + (gray ? "Yes" : "No") + "\n";
}

std::string all_stats(const Image& image, const Listing& what, size_t subimage) {
    const Part& part = image.part(subimage);
    if (part.mip_levels() == 1)
        return stats_text(image, "    ", subimage, 0, what.roi);
    std::string text;
    for (int level = 0; level < (what.all_subimages ? part.mip_levels() : 1); ++level) {
        const OIIO::ImageSpec& spec = part.header(level);
        text += what.all_subimages ? format("    MIP {} of {} ({} x {}):\n", level,
                                            part.mip_levels(), spec.width, spec.height)
                                   : "";
        text += stats_text(image, "      ", subimage, level, what.roi);
    }
    return text;
}

// One pixel's values: integers as they are stored, then as numbers between 0 and 1.
std::string pixel_text(const std::vector<float>& values, OIIO::TypeDesc type, bool in_c) {
    Scale scale({type, {}, 0});
    auto stored = [&](float value) {
        return type.is_floating_point() ? format("{:.9f}", value) : scale.whole(value);
    };
    if (in_c)
        return "{ " + shown(values, stored, ", ") + " }";
    std::string text = shown(values, stored);
    auto plain = [](float value) { return format("{}", value); };
    return type.is_floating_point() ? text : text + " (" + shown(values, plain) + ")";
}

std::string dump_text(const Image& image, const Listing& what, size_t subimage) {
    const OIIO::ImageBuf& pixels = image.part(subimage).pixels();
    const OIIO::ImageSpec& spec = pixels.spec();
    if (spec.deep)
        return deep_dump_text(pixels, what.dump_black);
    OIIO::TypeDesc type = image.part(subimage).format().value_or(DataFormat{}).type;
    std::string text = what.dump->empty() ? ""
                                          : format("{} {}[{}][{}][{}] =\n{{\n", type, *what.dump,
                                                   spec.height, spec.width, spec.nchannels);
    const auto add = [&](int x, int y, const std::vector<float>& values) {
        const bool last = x == spec.x + spec.width - 1;
        if (!what.dump->empty()) {
            text += format("{}/* ({}, {}): */ {}{}\n", x == spec.x ? "  { " : "    ", x, y,
                           pixel_text(values, type, true), last ? " }," : ",");
        } else if (what.dump_black || values != std::vector<float>(values.size())) {
            text += format("    Pixel ({}, {}): {}\n", x, y, pixel_text(values, type, false));
        }
    };
    for_each_row(pixels, pixels.roi(), [&](int y, const float* row) {
        for (int x = 0; x < spec.width; ++x, row += spec.nchannels)
            add(spec.x + x, y, {row, row + spec.nchannels});
    });
    return text + (what.dump->empty() ? "" : "};\n");
}

std::string matching_lines(const std::string& text, const Listing& what) {
    if (what.metamatch.empty() && what.no_metamatch.empty())
        return text;
    const std::regex wanted(what.metamatch), unwanted(what.no_metamatch);
    std::string kept;
    for (const std::string& line : OIIO::Strutil::splits(text, "\n")) {
        std::string name = line.substr(0, line.find(": "));
        bool keep = (what.metamatch.empty() || std::regex_search(name, wanted)) &&
                    (what.no_metamatch.empty() || !std::regex_search(name, unwanted));
        kept += keep && !line.empty() ? line + "\n" : "";
    }
    return kept;
}

std::string xml_text(const Image& image, size_t subimage, bool verbose) {
    std::string text = image.part(subimage).header().serialize(
        OIIO::ImageSpec::SerialXML,
        verbose ? OIIO::ImageSpec::SerialDetailed : OIIO::ImageSpec::SerialBrief);
    if (image.part_count() > 1)
        text.insert(text.find('\n') + 1, format("<subimages>{}</subimages>\n", image.part_count()));
    return text;
}

// Prints what follows the line of the image or of one of its subimages.
std::string subimage_text(const Image& image, const Listing& what, size_t subimage) {
    const Part& part = image.part(subimage);
    std::string text = what.verbose && part.mip_levels() > 1 ? mip_line(part) : "";
    if (what.hash)
        text += "    SHA-1: " + stored_hash(image.name(), int(subimage)) + "\n";
    if (what.verbose) {
        std::string detailed = header_text(image, subimage, true, what.named || what.native);
        text += detailed.substr(detailed.find('\n') + 1);
    }
    text += what.dump ? dump_text(image, what, subimage) : "";
    return text + (what.stats ? all_stats(image, what, subimage) : "");
}

} // namespace

std::string header_text(const Image& image, size_t subimage, bool detailed, bool native) {
    OIIO::ImageSpec spec = image.part(subimage).header();
    if (!native && !spec.deep)
        spec.set_format(OIIO::TypeFloat);
    std::string text =
        spec.serialize(OIIO::ImageSpec::SerialText, detailed ? OIIO::ImageSpec::SerialDetailedHuman
                                                             : OIIO::ImageSpec::SerialBrief);
    text.insert(std::min(text.find('\n'), text.size()), " " + image.file_format());
    return OIIO::Strutil::unescape_chars(text);
}

std::string stats_text(const Image& image, const std::string& indent, size_t subimage, int level,
                       OIIO::ROI roi) {
    const OIIO::ImageBuf& pixels = image.part(subimage).pixels(level);
    auto stats = OIIO::ImageBufAlgo::computePixelStats(pixels, roi);
    if (stats.min.empty())
        throw CommandError("cannot measure \"" + image.name() + "\": " + pixels.geterror());
    Part& part = image.part(subimage);
    Scale scale(part.from_file() ? *part.format() : DataFormat{});
    auto whole = [&](float value) { return scale.whole(value); };
    auto fraction = [&](float value) { return scale.fraction(value); };
    auto count = [](auto value) { return std::to_string(value); };
    const std::pair<const char*, std::string> lines[] = {
        {"Min", shown(stats.min, whole) + scale.note()},
        {"Max", shown(stats.max, whole) + scale.note()},
        {"Avg", shown(stats.avg, fraction) + scale.note()},
        {"StdDev", shown(stats.stddev, fraction) + scale.note()},
        {"NanCount", shown(stats.nancount, count) + " "},
        {"InfCount", shown(stats.infcount, count) + " "},
        {"FiniteCount", shown(stats.finitecount, count) + " "}};
    std::string text;
    for (const auto& [name, value] : lines)
        text += indent + "Stats " + name + ": " + value + "\n";
    return text + (pixels.deep() ? deep_stats_text(pixels, indent)
                                 : constant_lines(pixels, scale, indent));
}

std::string listing_text(const Image& image, const Listing& what) {
    if (what.format == "xml")
        return xml_text(image, 0, what.verbose);
    const size_t count = image.part_count();
    const bool each = what.all_subimages && count > 1;
    auto brief = [&](size_t subimage) -> std::string {
        return OIIO::Strutil::rstrip(header_text(image, subimage, false, what.named || what.native),
                                     "\n");
    };
    std::string more = what.verbose ? "" : (count > 1 ? format(" ({} subimages)", count) : "");
    std::string text = what.dump && !what.dump->empty() ? "// " : "";
    text += (what.named ? format("{:<20} : ", image.name()) : std::string()) + brief(0) + more;
    text += !what.verbose && image.part().mip_levels() > 1 ? " (+mipmap)\n" : "\n";
    text += what.verbose && count > 1 ? subimages_line(image) : "";
    for (size_t subimage = 0; subimage < (each ? count : 1); ++subimage) {
        text += each ? format(" subimage {:2}: ", subimage) + brief(subimage) +
                           (subimage > 0 ? more : "") + "\n"
                     : "";
        text += subimage_text(image, what, subimage);
    }
    return matching_lines(text, what);
}

std::string formats_text(bool lenient) {
    // Looking for a format makes OpenImageIO list its own beside the recipes that are ours.
    (void)OIIO::ImageInput::create("no.format");
    (void)OIIO::geterror();
    Strings entries = OIIO::Strutil::splits(OIIO::get_string_attribute("extension_list"), ";");
    std::sort(entries.begin(), entries.end(), [](const std::string& a, const std::string& b) {
        return a.substr(0, a.find(':')) < b.substr(0, b.find(':'));
    });
    std::string text = "All OIIO supported formats and their extensions:";
    for (const std::string& entry : entries) {
        const Strings words = split(entry, ':');
        if (!lenient || words[0] != "tone")
            text += "\n    " + words[0] + " : " + join(split(words.back(), ','), ", ");
    }
    return text;
}

} // namespace tonetool::chain
