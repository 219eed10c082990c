// Commands that change headers and leave the pixels as they are.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <regex>

#include "chain/ops.h"

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
    for (unsigned part : time) {
        packed[0] = packed[0] << 8U | (part / 10 % 10) << 4U | part % 10;
    }
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

void set_attribute(ImageSpec& spec, const std::string& name, const std::string& value,
                   OIIO::TypeDesc type) {
    if (value.empty()) {
        spec.erase_attribute(name);
    } else if (type == OIIO::TypeTimeCode || type == OIIO::TypeRational) {
        set_packed(spec, name, value, type);
    } else if (type.basetype == OIIO::TypeDesc::STRING && type.arraylen != 0) {
        set_strings(spec, name, value, type);
    } else if (type != OIIO::TypeUnknown) {
        spec.attribute(name, type, value);
    } else if (OIIO::Strutil::string_is_int(value)) {
        spec.attribute(name, OIIO::Strutil::stoi(value));
    } else if (OIIO::Strutil::string_is_float(value)) {
        spec.attribute(name, OIIO::Strutil::stof(value));
    } else {
        spec.attribute(name, value);
    }
}

void attrib(ImageSpec& spec, const Call& call, Session& session) {
    OIIO::TypeDesc type;
    auto name = call.text("type");
    if (name && type.fromstring(*name) != name->size() && !session.compat) {
        throw CommandError("type \"" + *name +
                           "\" is no data type (valid: int, float, string, "
                           "float[3], timecode, rational, ...)");
    }
    set_attribute(spec, call.argument(0), call.argument(1), type);
}

void erase(ImageSpec& spec, const Call& call, Session& session) {
    try {
        std::regex checked(call.argument(0), std::regex_constants::basic);
        spec.erase_attribute(call.argument(0));
    } catch (const std::regex_error& problem) {
        if (!session.compat) {
            throw CommandError("\"" + call.argument(0) +
                               "\" is no regular expression: " + problem.what());
        }
    }
}

void keyword(ImageSpec& spec, const Call& call, Session&) {
    std::vector<std::string> words =
        OIIO::Strutil::splits(spec.get_string_attribute("Keywords"), ";");
    words.push_back(call.argument(0));
    Strings kept;
    for (const std::string& word : words) {
        const std::string bare = OIIO::Strutil::strip(word);
        if (!bare.empty() && std::find(kept.begin(), kept.end(), bare) == kept.end()) {
            kept.push_back(bare);
        }
    }
    spec.attribute("Keywords", join(kept, "; "));
}

void orientation(ImageSpec& spec, const Call& call, Session& session) {
    const std::string& text = call.argument(0);
    spec.attribute("Orientation", session.compat ? OIIO::Strutil::stoi(text)
                                                 : checked_integer("ORIENT", text, {1, 8}));
}

void turn(ImageSpec& spec, const std::array<int, 9>& to) {
    const int now = spec.get_int_attribute("Orientation", 1);
    if (now >= 0 && now <= 8) {
        spec.attribute("Orientation", to[size_t(now)]);
    }
}

void fullsize(ImageSpec& spec, const Call& call, Session& session) {
    OIIO::ROI window = spec.roi_full();
    adjust_window(session, call, call.argument(0), Geometry::Window, window);
    window.chend = spec.nchannels;
    spec.set_roi_full(window);
}

void move_origin(ImageSpec& spec, const Call& call, Session& session, bool by) {
    OIIO::ROI window = by ? OIIO::ROI(0, 0, 0, 0) : spec.roi();
    if (adjust_window(session, call, call.argument(0), Geometry::Position, window) || !by) {
        spec.x = window.xbegin + (by ? spec.x : 0);
        spec.y = window.ybegin + (by ? spec.y : 0);
    }
}

void chnames(ImageSpec& spec, const Call& call, Session& session) {
    Strings wanted = split(call.argument(0), ',');
    Strings& names = spec.channelnames;
    if (wanted.size() > names.size() && !session.compat) {
        throw CommandError("\"" + call.argument(0) + "\" names " + std::to_string(wanted.size()) +
                           " channels, the image has " + std::to_string(names.size()));
    }
    for (size_t c = 0; c < std::min(wanted.size(), names.size()); ++c) {
        names[c] = wanted[c].empty() ? names[c] : wanted[c];
        spec.alpha_channel = names[c] == "A" ? int(c) : spec.alpha_channel;
        spec.z_channel = names[c] == "Z" ? int(c) : spec.z_channel;
    }
    Strings sorted = names;
    std::sort(sorted.begin(), sorted.end());
    auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end() && !session.compat) {
        throw CommandError("two channels would be called \"" + *twice + "\"");
    }
}

const std::vector<HeaderRow> attribute_rows = {
    {"attrib NAME VALUE", "Set an attribute, or erase it with an empty value", attrib,
     "type=TYPE: its data type (what VALUE looks like)"},
    {"sattrib NAME VALUE", "Set an attribute that is a string",
     [](ImageSpec& spec, const Call& call, Session&) {
         set_attribute(spec, call.argument(0), call.argument(1), OIIO::TypeString);
     }},
    {"eraseattrib REGEX", "Erase the attributes that match", erase},
    {"caption TEXT", "Set the caption (ImageDescription)",
     [](ImageSpec& spec, const Call& call, Session&) {
         set_attribute(spec, "ImageDescription", call.argument(0), OIIO::TypeString);
     }},
    {"keyword KEYWORD", "Add a keyword", keyword},
    {"clear-keywords", "Erase all keywords",
     [](ImageSpec& spec, const Call&, Session&) { spec.erase_attribute("Keywords"); }},
    {"iscolorspace COLORSPACE", "Say what colour space the image is in",
     [](ImageSpec& spec, const Call& call, Session&) {
         set_attribute(spec, "oiio:ColorSpace", call.argument(0), OIIO::TypeString);
     }},
};

const std::vector<HeaderRow> window_rows = {
    {"orientation ORIENT", "Say how the image is turned (1 to 8)", orientation},
    {"orientcw", "Turn the Orientation by 90 degrees clockwise",
     [](ImageSpec& spec, const Call&, Session&) {
         turn(spec, {0, 6, 7, 8, 5, 2, 3, 4, 1});
     }},
    {"orientccw", "Turn the Orientation by 90 degrees counter-clockwise",
     [](ImageSpec& spec, const Call&, Session&) {
         turn(spec, {0, 8, 5, 6, 7, 4, 1, 2, 3});
     }},
    {"orient180", "Turn the Orientation by 180 degrees",
     [](ImageSpec& spec, const Call&, Session&) {
         turn(spec, {0, 3, 4, 1, 2, 7, 8, 5, 6});
     }},
    {"origin +X+Y", "Set the origin of the data window",
     [](ImageSpec& spec, const Call& call, Session& session) {
         move_origin(spec, call, session, false);
     }},
    {"originoffset +X+Y", "Move the origin of the data window",
     [](ImageSpec& spec, const Call& call, Session& session) {
         move_origin(spec, call, session, true);
     }},
    {"fullsize GEOM", "Set the display window", fullsize},
    {"fullpixels", "Make the data window the display window",
     [](ImageSpec& spec, const Call&, Session&) { spec.set_roi_full(spec.roi()); }},
    {"chnames NAMELIST", "Rename the channels (an empty name stays as it is)", chnames},
};

} // namespace

std::vector<Command> metadata_commands() {
    std::vector<Command> all = header_rows(Group::Metadata, attribute_rows);
    append(all, header_rows(Group::Metadata, window_rows));
    return all;
}

} // namespace tonetool::chain
