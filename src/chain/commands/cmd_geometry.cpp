// SPDX-License-Identifier: BSD-3-Clause
// Commands that move, cut, turn and resample pixels.
#include "chain/commands/commands.h"
#include "chain/session/ops.h"
#include "imagebuf/pixels/oiio_compat.h"

namespace tonetool::chain {

namespace {

const Modifiers kFilters = {
    {"filter", "NAME", "reconstruction filter (lanczos3, box, cubic, ...)"}};
const Modifiers kResizing =
    concatenated({kFilters, {{"highlightcomp", "0|1", "compress highlights while filtering"}}});
const Modifiers kWarping =
    concatenated({kResizing, {{"recompute_roi", "0|1", "grow the data window as needed"}}});

// Runs a filter on the image; with highlightcomp= between compressing and expanding its highlights.
template <class Filter>
bool filtered(Op& op, Filter filter) {
    if (!op.flag("highlightcomp"))
        return filter(op.a());
    OIIO::ImageBuf compressed;
    return IBA::rangecompress(compressed, op.a()) && filter(compressed) &&
           IBA::rangeexpand(op.dst, op.dst);
}

bool crop_to(Op& op, const OIIO::ROI& window) {
    const OIIO::ROI now = op.a().roi();
    op.unchanged = window.xbegin == now.xbegin && window.xend == now.xend &&
                   window.ybegin == now.ybegin && window.yend == now.yend;
    return op.unchanged || IBA::crop(op.dst, op.a(), window);
}

OIIO::ROI asked_window(Op& op, OIIO::ROI window, Geometry allowed) {
    adjust_window(op.session, op.call, op.call.argument(0), allowed, window);
    return window;
}

bool crop(Op& op) {
    return crop_to(op, asked_window(op, op.a().roi(), Geometry::Window));
}

bool cut(Op& op) {
    return IBA::cut(op.dst, op.a(), asked_window(op, op.a().roi(), Geometry::Window));
}

bool trim(Op& op) {
    const Image& image = *op.call.images.front();
    const Chosen chosen = chosen_subimages(op.session, op.call, image);
    OIIO::ROI window;
    for (size_t s = 0; s < chosen.count; ++s) {
        OIIO::ROI part =
            chosen.active[s] ? IBA::nonzero_region(image.part(s).pixels()) : OIIO::ROI();
        window = part.npixels() == 0 ? window : OIIO::roi_union(window, part);
    }
    const OIIO::ROI now = op.a().roi();
    const OIIO::ROI first(now.xbegin, now.xbegin + 1, now.ybegin, now.ybegin + 1);
    return crop_to(op, window.npixels() > 0 ? window : first);
}

bool scale_to(Op& op, const OIIO::ROI& display, bool resample) {
    const OIIO::ROI now = op.a().roi_full();
    op.unchanged = display.width() == now.width() && display.height() == now.height();
    if (op.unchanged)
        return true;
    op.dst.reset(scaled_spec(op.a().spec(), display));
    const OIIO::ROI roi = op.dst.roi();
    return resample ? IBA::resample(op.dst, op.a(), op.flag("interp", true), roi)
                    : filtered(op, [&](const OIIO::ImageBuf& from) {
                          return oiio::resize(op.dst, from, op.text("filter"), roi);
                      });
}

bool resize(Op& op) {
    return scale_to(op, asked_window(op, op.a().roi_full(), Geometry::Scalable), false);
}

bool resample(Op& op) {
    return scale_to(op, asked_window(op, op.a().roi_full(), Geometry::Scalable), true);
}

bool fit(Op& op) {
    const OIIO::ROI display = asked_window(op, op.a().roi_full(), Geometry::Window);
    const OIIO::ROI size(0, display.width(), 0, display.height(), 0, 1, 0, op.a().nchannels());
    bool done = filtered(op, [&](const OIIO::ImageBuf& from) {
        return oiio::fit(op.dst, from, op.text("filter"), op.text("fillmode", "letterbox"),
                         op.flag("exact"), size);
    });
    op.dst.set_roi_full(display);
    OIIO::ImageBuf padded;
    if (done && op.flag("pad") && IBA::crop(padded, op.dst, op.dst.roi_full()))
        op.dst = std::move(padded);
    return done;
}

bool pixelaspect(Op& op) {
    const float wanted = op.number(0);
    if (wanted <= 0) {
        throw CommandError("Invalid pixel aspect ratio '" + format_number(wanted) + "'" +
                           (op.session.settings.compat ? "" : " (valid: above 0)"));
    }
    const OIIO::ImageSpec& spec = op.a().spec();
    const float factor = spec.get_float_attribute("PixelAspectRatio", 1) / wanted;
    const float x = factor > 1 ? factor : 1, y = factor < 1 ? 1 / factor : 1;
    // NOLINTBEGIN(bugprone-incorrect-roundings): as oiiotool rounds
    const OIIO::ROI display(0, int(float(spec.full_width) * x + 0.5F), 0,
                            int(float(spec.full_height) * y + 0.5F));
    // NOLINTEND(bugprone-incorrect-roundings)
    bool done = scale_to(op, display, false);
    if (done && !op.unchanged) {
        op.dst.specmod().attribute("PixelAspectRatio", wanted);
        for (auto [name, scale] : {std::pair("XResolution", x), std::pair("YResolution", y)})
            if (const float resolution = spec.get_float_attribute(name, 0); resolution != 0)
                op.dst.specmod().attribute(name, resolution * scale);
    }
    return done;
}

bool rotate(Op& op) {
    const float angle = op.number(0) * float(M_PI / 180.0);
    const Floats center = op.call.has("center") ? op.list("center", op.text("center")) : Floats();
    if (!op.session.settings.compat && op.call.has("center") && center.size() != 2)
        throw CommandError("center \"" + op.text("center") + "\" is not a position (valid: X,Y)");
    const std::string filter = op.text("filter");
    const bool recomputed = op.flag("recompute_roi");
    return filtered(op, [&](const OIIO::ImageBuf& from) {
        return center.size() == 2
                   ? IBA::rotate(op.dst, from, angle, center[0], center[1], filter, 0, recomputed)
                   : IBA::rotate(op.dst, from, angle, filter, 0, recomputed);
    });
}

bool warp(Op& op) {
    const Floats m = op.list("MATRIX", op.call.argument(0));
    if (m.size() != 9)
        throw CommandError("expected 9 comma-separated floats to form a 3x3 matrix", "", true);
    const float matrix[3][3] = {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
    const std::string wrap = op.text("wrap", "black");
    if (!op.session.settings.compat)
        check_choice("wrap", wrap, {"black", "clamp", "periodic", "mirror"});
    return filtered(op, [&](const OIIO::ImageBuf& from) {
        return IBA::warp(op.dst, from, matrix, op.text("filter"), 0, op.flag("recompute_roi"),
                         OIIO::ImageBuf::WrapMode_from_string(wrap));
    });
}

bool cshift(Op& op) {
    const std::string& text = op.call.argument(0);
    int x = 0, y = 0, end = 0;
    bool found = std::sscanf(text.c_str(), "%d%d%n", &x, &y, &end) == 2;
    if (!found || (!op.session.settings.compat && size_t(end) < text.size())) {
        throw CommandError("Invalid shift offset '" + text + "'" +
                               (op.session.settings.compat ? "" : " (valid: +X+Y)"),
                           "", true);
    }
    return IBA::circular_shift(op.dst, op.a(), x, y);
}

bool st_warp(Op& op) {
    return IBA::st_warp(op.dst, op.a(), op.b(), op.text("filter"), 0, op.integer("chan_s", 0),
                        op.integer("chan_t", 1), op.flag("flip_s"), op.flag("flip_t"));
}

bool reorient(Op& op) {
    op.unchanged = op.a().orientation() == 1;
    return op.unchanged || IBA::reorient(op.dst, op.a());
}

const Rows kGeometryRows = {
    on_pixels("crop GEOM", 1,
              "Set the data window, cropping or padding (WxH+X+Y or XMIN,YMIN,XMAX,YMAX)", crop)
        .operation(""),
    on_pixels("croptofull", 1, "Crop or pad to the display window",
              [](Op& op) { return crop_to(op, op.a().roi_full()); })
        .operation(""),
    on_pixels("trim", 1, "Crop to the smallest window of pixels that are not 0", trim)
        .operation(""),
    on_pixels("cut GEOM", 1, "Cut out a window and move it to the origin", cut).operation(""),
    on_pixels("cshift +X+Y", 1,
              "Shift circularly: pixels that leave at one edge return at the opposite one", cshift),
    on_pixels("resample GEOM", 1, "Resample (640x480, 640x0, 50%)", resample)
        .modifier("interp", "0|1", "bilinear (1) or nearest")
        .operation("resample"),
    on_pixels("resize GEOM", 1, "Resize with a filter (640x480, 640x0, 50%)", resize)
        .modifiers(kResizing)
        .operation("resize"),
    on_pixels("fit GEOM", 1, "Resize to fit within a window", fit)
        .modifiers(kResizing)
        .modifier("pad", "0|1", "pad to the window")
        .modifier("fillmode", "letterbox|width|height",
                  "the dimension that must fit (letterbox: both)")
        .modifier("exact", "0|1", "fit exactly, not to whole pixels")
        .operation(""),
    on_pixels("pixelaspect ASPECT", 1, "Scale up width or height for another pixel aspect ratio",
              pixelaspect)
        .modifiers(kResizing)
        .operation("resize"),
    on_pixels("rotate DEGREES", 1, "Rotate clockwise around the middle of the display window",
              rotate)
        .modifiers(kWarping)
        .modifier("center", "X,Y", "centre of the rotation"),
    on_pixels("warp MATRIX", 1, "Warp by a 3x3 matrix of 9 numbers with commas between them", warp)
        .modifiers(kWarping)
        .modifier("wrap", "MODE", "pixels beyond the image: black, clamp, periodic, mirror"),
    on_pixels("st_warp", 2, "Warp the first image by the st coordinates in the second", st_warp)
        .modifiers(kFilters)
        .modifier("chan_s", "N", "channel of s (0)")
        .modifier("chan_t", "N", "channel of t (1)")
        .modifier("flip_s", "0|1", "s runs from the right")
        .modifier("flip_t", "0|1", "t runs from the bottom"),
    on_pixels("rotate90", 1, "Rotate by 90 degrees clockwise", of_one<IBA::rotate90>),
    on_pixels("rotate180|flipflop", 1, "Rotate by 180 degrees", of_one<IBA::rotate180>),
    on_pixels("rotate270", 1, "Rotate by 270 degrees clockwise", of_one<IBA::rotate270>),
    on_pixels("flip", 1, "Mirror top and bottom", of_one<IBA::flip>),
    on_pixels("flop", 1, "Mirror left and right", of_one<IBA::flop>),
    on_pixels("transpose", 1, "Swap x and y", of_one<IBA::transpose>),
    on_pixels("reorient", 1, "Turn the pixels as the Orientation says", reorient)
        .operation("reorient"),
};

} // namespace

Rows geometry_commands() {
    return kGeometryRows;
}

} // namespace tonetool::chain
