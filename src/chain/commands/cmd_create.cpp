// SPDX-License-Identifier: BSD-3-Clause
// Commands that create images, and draw.
#include <OpenImageIO/strutil.h>

#include "chain/commands/commands.h"
#include "chain/session/ops.h"
#include "imagebuf/pixels/oiio_compat.h"

namespace tonetool::chain {

namespace {

using Corners = std::vector<Floats>;

// The window and the number of channels of the last two arguments.
OIIO::ImageBuf blank(Session& session, const Call& call, size_t first) {
    OIIO::ROI window(0, 64, 0, 64);
    adjust_window(session, call, call.argument(first), Geometry::Window, window);
    OIIO::ImageBuf image;
    const Op op{session, call, image, {}};
    int channels = op.integer(first + 1);
    if (channels < 1 || channels > 1024) {
        const std::string why = "Invalid number of channels: " + std::to_string(channels);
        if (!session.settings.compat)
            throw CommandError(why + " (valid: 1 to 1024)");
        session.warning(call.text(), why);
        channels = 3;
    }
    OIIO::ImageSpec spec(window.width(), window.height(), channels,
                         OIIO::TypeDesc(op.text("type", "float")));
    spec.x = spec.full_x = window.xbegin;
    spec.y = spec.full_y = window.ybegin;
    image.reset(spec);
    IBA::zero(image);
    return image;
}

void push_created(Session& session, OIIO::ImageBuf image) {
    if (image.has_error())
        throw CommandError(image.geterror());
    session.stack.push(Image::created("new", std::move(image)));
}

void run_create(Session& session, const Call& call) {
    push_created(session, blank(session, call, 0));
}

// A value for each channel. Beyond them there may be an alpha, which these commands do not use, as
// oiiotool's do not.
Floats color_of(const Op& op, const std::string& key, float otherwise = 1) {
    const size_t channels = size_t(op.a().nchannels());
    const auto words = op.call.text(key);
    Floats color =
        words ? op.per_value(key, *words, otherwise, channels + 1) : Floats(channels, otherwise);
    color.resize(channels);
    return color;
}

// The values of all of these modifiers, or none.
Corners colors(const Op& op, const Strings& keys) {
    Corners found;
    for (const std::string& key : keys)
        if (op.call.has(key))
            found.push_back(color_of(op, key));
    return found.size() == keys.size() ? found : Corners();
}

bool fill(Op& op, const OIIO::ROI& window) {
    if (Corners four = colors(op, {"topleft", "topright", "bottomleft", "bottomright"});
        !four.empty())
        return IBA::fill(op.dst, four[0], four[1], four[2], four[3], window);
    if (Corners two = colors(op, {"top", "bottom"}); !two.empty())
        return IBA::fill(op.dst, two[0], two[1], window);
    if (Corners two = colors(op, {"left", "right"}); !two.empty())
        return IBA::fill(op.dst, two[0], two[1], two[0], two[1], window);
    if (!op.call.has("color") && op.session.settings.compat && op.call.row().label() == "pattern")
        return true; // black, without a message
    if (!op.call.has("color")) {
        const std::string why = "No recognized fill parameters";
        if (!op.session.settings.compat) {
            throw CommandError(why + " (valid: color=, or top= and bottom=, or left= and "
                                     "right=, or topleft=, "
                                     "topright=, bottomleft= and bottomright=)");
        }
        op.session.warning(op.call.text(), why + ": filling with white.");
    }
    return IBA::fill(op.dst, color_of(op, "color"), window);
}

bool checker(Op& op) {
    const int width = op.integer("width", 8);
    return IBA::checker(op.dst, width, op.integer("height", width), op.integer("depth", width),
                        color_of(op, "color1", 0), color_of(op, "color2"));
}

bool draw_pattern(Op& op, const std::string& pattern) {
    static const Strings names = {"black", "constant", "fill", "checker", "noise"};
    if (pattern == "noise")
        return add_noise(op, true);
    if (pattern == "checker")
        return checker(op);
    if (pattern == "fill")
        return fill(op, op.dst.roi());
    if (pattern == "constant")
        return IBA::fill(op.dst, color_of(op, "color"));
    if (!op.session.settings.compat)
        check_choice("pattern", pattern, names);
    else if (pattern != "black")
        op.session.warning("--pattern", "Unknown pattern \"" + pattern + "\"");
    return true;
}

void run_pattern(Session& session, const Call& call) {
    OIIO::ImageBuf image = blank(session, call, 1);
    const Token pattern = parse_token("--" + call.argument(0), session.settings.compat);
    const Call own(call.row(), pattern, {}, session.settings.compat);
    Op op{session, own, image, {&image}};
    draw_pattern(op, pattern.name);
    push_created(session, std::move(image));
}

void run_kernel_command(Session& session, const Call& call) {
    auto size = parsed_size(call.argument(1));
    if (!size)
        throw CommandError("Unknown size " + call.argument(1));
    push_created(session, IBA::make_kernel(call.argument(0), size->width, size->height));
}

void run_capture(Session& session, const Call& call) {
    OIIO::ImageBuf image;
    push_created(session, oiio::capture_image(Op{session, call, image, {}}.integer("camera", 0)));
}

// The positions of the argument: at least `least` numbers, in pairs.
std::vector<int> positions(const Op& op, size_t least) {
    std::vector<int> all;
    for (float value : op.list(op.call.row().args.front(), op.call.argument(0)))
        all.push_back(static_cast<int>(value));
    if (all.size() < least || (all.size() % 2 != 0 && !op.session.settings.compat)) {
        throw CommandError("\"" + op.call.argument(0) + "\" has " + std::to_string(all.size()) +
                           " numbers (valid: " + op.call.row().args.front() + ")");
    }
    return all;
}

// A colour to draw with: a value for each channel, then its alpha, which is used where the image
// has none. As in oiiotool a single value is that of the alpha, too.
Floats paint(const Op& op) {
    const size_t values = size_t(op.a().nchannels()) + 1;
    const auto words = op.call.text("color");
    return words ? op.per_value("color", *words, 1, values) : Floats(values, 1.0F);
}

bool point(Op& op) {
    const std::vector<int> at = positions(op, 2);
    bool done = op.dst.copy(op.a());
    for (size_t i = 0; done && i + 1 < at.size(); i += 2)
        done = IBA::render_point(op.dst, at[i], at[i + 1], color_of(op, "color"));
    return done;
}

bool line(Op& op) {
    const std::vector<int> at = positions(op, 4);
    bool done = op.dst.copy(op.a());
    for (size_t i = 0; done && i + 3 < at.size(); i += 2)
        done = IBA::render_line(op.dst, at[i], at[i + 1], at[i + 2], at[i + 3], paint(op), i > 0);
    return done;
}

bool box(Op& op) {
    const std::vector<int> at = positions(op, 4);
    return op.dst.copy(op.a()) &&
           IBA::render_box(op.dst, at[0], at[1], at[2], at[3], paint(op), op.flag("fill"));
}

bool fill_window(Op& op) {
    OIIO::ROI window = op.a().roi();
    adjust_window(op.session, op.call, op.call.argument(0), Geometry::Window, window);
    window.chend = op.a().nchannels();
    return op.dst.copy(op.a()) && fill(op, window);
}

template <class Align>
Align aligned(const Op& op, const std::string& key,
              const std::vector<std::pair<const char*, Align>>& names) {
    Strings valid;
    Align found = names.front().second;
    for (const auto& [name, value] : names) {
        valid.push_back(name);
        found = op.text(key) == name ? value : found;
    }
    if (op.call.has(key) && !op.session.settings.compat)
        check_choice(key, op.text(key), valid);
    return found;
}

bool text(Op& op) {
    using X = IBA::TextAlignX;
    using Y = IBA::TextAlignY;
    const OIIO::ImageSpec& spec = op.a().spec();
    auto x =
        aligned<X>(op, "xalign", {{"left", X::Left}, {"right", X::Right}, {"center", X::Center}});
    auto y = aligned<Y>(
        op, "yalign",
        {{"base", Y::Baseline}, {"top", Y::Top}, {"bottom", Y::Bottom}, {"center", Y::Center}});
    return op.dst.copy(op.a()) &&
           IBA::render_text(op.dst, op.integer("x", spec.x + spec.width / 2),
                            op.integer("y", spec.y + spec.height / 2), op.call.argument(0),
                            op.integer("size", 16), op.text("font"), paint(op), x, y,
                            op.integer("shadow", 0));
}

const Modifiers kColor = {{"color", "VALUES", "one value, or one per channel (1)"}};
const Modifiers kRamps = {{"top", "VALUES", "colour at the top, to bottom="},
                          {"bottom", "VALUES", "colour at the bottom"},
                          {"left", "VALUES", "colour at the left, to right="},
                          {"right", "VALUES", "colour at the right"},
                          {"topleft", "VALUES", "colour of a corner, with the other three"},
                          {"topright", "VALUES", "colour of a corner"},
                          {"bottomleft", "VALUES", "colour of a corner"},
                          {"bottomright", "VALUES", "colour of a corner"}};

const Rows kCreateRows = {
    command("create GEOM NCHANS", "A black image", run_create)
        .images(0, 1)
        .modifier("type", "TYPE", "data type (float)"),
    command("pattern NAME[:...] GEOM NCHANS",
            "An image of a pattern: black, constant, fill, checker, noise", run_pattern)
        .images(0, 1)
        .modifiers(kColor, kRamps, noise_modifiers())
        .modifier("width", "N", "width of a checker's squares (8)")
        .modifier("height", "N", "height of a checker's squares (width)")
        .modifier("depth", "N", "depth of a checker's squares (width)")
        .modifier("color1", "VALUES", "first colour of a checker (0)")
        .modifier("color2", "VALUES", "second colour of a checker (1)"),
    command("kernel NAME WxH", "A convolution kernel", run_kernel_command)
        .images(0, 1)
        .operation("-kernel"),
    command("capture", "An image from a camera", run_capture)
        .images(0, 1)
        .modifier("camera", "N", "which camera (0)"),
    on_pixels("point X,Y[,X,Y...]", 1, "Draw points", point).modifiers(kColor),
    on_pixels("line X,Y,X,Y[,X,Y...]", 1, "Draw a line through these points", line)
        .modifiers(kColor),
    on_pixels("box X1,Y1,X2,Y2", 1, "Draw a box", box)
        .modifiers(kColor)
        .modifier("fill", "0|1", "filled"),
    on_pixels("fill GEOM", 1, "Fill a window with a colour or a ramp", fill_window)
        .modifiers(kColor, kRamps)
        .operation(""),
    on_pixels("text TEXT", 1, "Draw text", text)
        .modifiers(kColor)
        .modifier("x", "N", "position (the middle)")
        .modifier("y", "N", "position (the middle)")
        .modifier("size", "N", "height of the letters (16)")
        .modifier("font", "NAME", "font, a name or a file")
        .modifier("xalign", "left|right|center", "alignment of the text to its position (left)")
        .modifier("yalign", "base|top|bottom|center",
                  "alignment of the text to its position (base)")
        .modifier("shadow", "N", "width of a black outline (0)"),
};

} // namespace

Rows create_commands() {
    return kCreateRows;
}

} // namespace tonetool::chain
