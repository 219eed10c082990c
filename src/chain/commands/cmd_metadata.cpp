// SPDX-License-Identifier: BSD-3-Clause
// Commands that change headers and leave the pixels as they are.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <regex>

#include "chain/commands/commands.h"
#include "chain/images/attributes.h"
#include "chain/session/ops.h"

namespace tonetool::chain {

namespace {

using OIIO::ImageSpec;

void attrib(ImageSpec& spec, const Call& call, Session& session) {
    OIIO::TypeDesc type;
    auto name = call.text("type");
    if (name && type.fromstring(*name) != name->size() && !session.settings.compat) {
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
        if (!session.settings.compat) {
            throw CommandError("\"" + call.argument(0) +
                               "\" is no regular expression: " + problem.what());
        }
    }
}

void keyword(ImageSpec& spec, const Call& call, Session&) {
    add_keyword(spec, call.argument(0));
}

void orientation(ImageSpec& spec, const Call& call, Session& session) {
    const std::string& text = call.argument(0);
    spec.attribute("Orientation", session.settings.compat
                                      ? OIIO::Strutil::stoi(text)
                                      : checked_integer("ORIENT", text, {1, 8}));
}

void turn(ImageSpec& spec, const std::array<int, 9>& to) {
    const int now = spec.get_int_attribute("Orientation", 1);
    if (now >= 0 && now <= 8)
        spec.attribute("Orientation", to[size_t(now)]);
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
    if (wanted.size() > names.size() && !session.settings.compat) {
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
    if (twice != sorted.end() && !session.settings.compat)
        throw CommandError("two channels would be called \"" + *twice + "\"");
}

const Rows kMetadataRows = {
    on_headers("attrib NAME VALUE", "Set an attribute, or erase it with an empty value", attrib)
        .modifier("type", "TYPE", "its data type (what VALUE looks like)")
        .keeps_header(),
    on_headers("sattrib NAME VALUE", "Set an attribute that is a string",
               [](ImageSpec& spec, const Call& call, Session&) {
                   set_attribute(spec, call.argument(0), call.argument(1), OIIO::TypeString);
               })
        .keeps_header(),
    on_headers("eraseattrib REGEX", "Erase the attributes that match", erase).keeps_header(),
    on_headers("caption TEXT", "Set the caption (ImageDescription)",
               [](ImageSpec& spec, const Call& call, Session&) {
                   set_attribute(spec, "ImageDescription", call.argument(0), OIIO::TypeString);
               })
        .keeps_header(),
    on_headers("keyword KEYWORD", "Add a keyword", keyword).keeps_header(),
    on_headers("clear-keywords", "Erase all keywords",
               [](ImageSpec& spec, const Call&, Session&) { spec.erase_attribute("Keywords"); })
        .keeps_header(),
    on_headers("iscolorspace COLORSPACE", "Say what colour space the image is in",
               [](ImageSpec& spec, const Call& call, Session&) {
                   set_attribute(spec, "oiio:ColorSpace", call.argument(0), OIIO::TypeString);
               })
        .keeps_header(),
    on_headers("orientation ORIENT", "Say how the image is turned (1 to 8)", orientation),
    on_headers("orientcw|rotcw", "Turn the Orientation by 90 degrees clockwise",
               [](ImageSpec& spec, const Call&, Session&) {
                   turn(spec, {0, 6, 7, 8, 5, 2, 3, 4, 1});
               }),
    on_headers("orientccw|rotccw", "Turn the Orientation by 90 degrees counter-clockwise",
               [](ImageSpec& spec, const Call&, Session&) {
                   turn(spec, {0, 8, 5, 6, 7, 4, 1, 2, 3});
               }),
    on_headers("orient180|rot180", "Turn the Orientation by 180 degrees",
               [](ImageSpec& spec, const Call&, Session&) {
                   turn(spec, {0, 3, 4, 1, 2, 7, 8, 5, 6});
               }),
    on_headers("origin +X+Y", "Set the origin of the data window",
               [](ImageSpec& spec, const Call& call, Session& session) {
                   move_origin(spec, call, session, false);
               }),
    on_headers("originoffset +X+Y", "Move the origin of the data window",
               [](ImageSpec& spec, const Call& call, Session& session) {
                   move_origin(spec, call, session, true);
               }),
    on_headers("fullsize GEOM", "Set the display window", fullsize),
    on_headers("fullpixels", "Make the data window the display window",
               [](ImageSpec& spec, const Call&, Session&) { spec.set_roi_full(spec.roi()); }),
    on_headers("chnames NAMELIST", "Rename the channels (an empty name stays as it is)", chnames),
};

} // namespace

Rows metadata_commands() {
    return kMetadataRows;
}

} // namespace tonetool::chain
