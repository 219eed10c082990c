// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/attributes.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cstdio>

#include "chain/images/inspect.h"
#include "text/error.h"
#include "text/text.h"
#include "tonetool/write.h"

namespace tonetool::chain {

namespace {

using OIIO::ImageSpec;

// "01:02:03:04" as the decimal digits of a time code, "30/1" as a rational number.
void set_packed(ImageSpec& spec, const std::string& name, const std::string& value,
                OIIO::TypeDesc type) {
    unsigned time[4] = {}, packed[2] = {};
    int ratio[2] = {0, 1};
    if (type == OIIO::TypeRational) {
        std::sscanf(value.c_str(), "%d/%d", &ratio[0], &ratio[1]);
        spec.attribute(name, type, ratio);
        return;
    }
    std::sscanf(value.c_str(), "%u:%u:%u:%u", &time[0], &time[1], &time[2], &time[3]);
    for (unsigned part : time)
        packed[0] = packed[0] << 8U | (part / 10 % 10) << 4U | part % 10;
    spec.attribute(name, type, packed);
}

void set_strings(ImageSpec& spec, const std::string& name, const std::string& value,
                 OIIO::TypeDesc type) {
    OIIO::string_view rest = value;
    std::vector<OIIO::ustring> words;
    OIIO::string_view word;
    while (OIIO::Strutil::parse_string(rest, word)) {
        words.emplace_back(word);
        OIIO::Strutil::parse_char(rest, ',');
    }
    words.resize(type.arraylen > 0 ? size_t(type.arraylen) : words.size());
    type.arraylen = int(words.size());
    spec.attribute(name, type, words.data());
}

std::string geometry(OIIO::ROI roi) {
    return OIIO::Strutil::fmt::format("{}x{}{:+d}{:+d}", roi.width(), roi.height(), roi.xbegin,
                                      roi.ybegin);
}

} // namespace

void set_attribute(ImageSpec& spec, const std::string& name, const std::string& value,
                   OIIO::TypeDesc type) {
    if (value.empty())
        spec.erase_attribute(name);
    else if (type == OIIO::TypeTimeCode || type == OIIO::TypeRational)
        set_packed(spec, name, value, type);
    else if (type.basetype == OIIO::TypeDesc::STRING && type.arraylen != 0)
        set_strings(spec, name, value, type);
    else if (type != OIIO::TypeUnknown)
        spec.attribute(name, type, value);
    else if (OIIO::Strutil::string_is_int(value))
        spec.attribute(name, OIIO::Strutil::stoi(value));
    else if (OIIO::Strutil::string_is_float(value))
        spec.attribute(name, OIIO::Strutil::stof(value));
    else
        spec.attribute(name, value);
}

void add_keyword(ImageSpec& spec, const std::string& word) {
    Strings words = OIIO::Strutil::splits(spec.get_string_attribute("Keywords"), ";"), kept;
    words.push_back(word);
    for (const std::string& each : words) {
        const std::string bare = OIIO::Strutil::strip(each);
        if (!bare.empty() && std::find(kept.begin(), kept.end(), bare) == kept.end())
            kept.push_back(bare);
    }
    spec.attribute("Keywords", join(kept, "; "));
}

void read_icc_profile(ImageSpec& spec, const std::string& filename) {
    std::string bytes;
    if (!OIIO::Filesystem::exists(filename))
        throw CommandError("ICC profile file " + filename + " does not exist");
    if (!OIIO::Filesystem::read_text_file(filename, bytes) || bytes.empty())
        throw CommandError("ICC profile file " + filename + " could not be read");
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(bytes.size())),
                   bytes.data());
}

void write_icc_profile(const ImageSpec& spec, const std::string& filename) {
    const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
    if (!profile)
        throw CommandError("No ICC profile found in image.");
    std::string why;
    if (!write_bytes({static_cast<const char*>(profile->data()), size_t(profile->datasize())},
                     filename, why))
        throw CommandError(why);
}

std::optional<std::string> attribute_text(const Image& image, const std::string& name) {
    Part& part = image.part();
    const ImageSpec& spec = part.header();
    using Stats = std::vector<float> OIIO::ImageBufAlgo::PixelStats::*;
    static const std::pair<const char*, Stats> stats[] = {
        {"MINCOLOR", &OIIO::ImageBufAlgo::PixelStats::min},
        {"MAXCOLOR", &OIIO::ImageBufAlgo::PixelStats::max},
        {"AVGCOLOR", &OIIO::ImageBufAlgo::PixelStats::avg}};
    for (const auto& [key, figures] : stats) {
        if (name == key) {
            return OIIO::Strutil::join(
                OIIO::ImageBufAlgo::computePixelStats(part.pixels()).*figures, ",");
        }
    }
    if (name == "META" || name == "METABRIEF")
        return std::string(OIIO::Strutil::rstrip(header_text(image, 0, name == "META")));
    const std::pair<const char*, std::string> known[] = {
        {"filename", image.name()},
        {"file_extension", OIIO::Filesystem::extension(image.name())},
        {"file_noextension", OIIO::Filesystem::replace_extension(image.name(), "")},
        {"geom", geometry(spec.roi())},
        {"full_geom", geometry(spec.roi_full())},
        {"format", part.from_file() ? "float" : std::string(spec.format.c_str())}};
    for (const auto& [key, value] : known)
        if (name == key)
            return value;
    if (name == "STATS")
        return std::string(OIIO::Strutil::rstrip(stats_text(image, "")));
    OIIO::ParamValue value;
    const OIIO::ParamValue* found = spec.find_attribute(name, value);
    return found ? std::optional<std::string>(found->get_string()) : std::nullopt;
}

} // namespace tonetool::chain
