// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/windows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "text/text.h"

namespace tonetool::chain {

namespace {

struct Window {
    int x, y, width, height;
};

enum class Found { Nothing, Origin, Sized, Scaled };

// As oiiotool rounds.
int rounded(float size) {
    return static_cast<int>(size + 0.5F); // NOLINT(bugprone-incorrect-roundings)
}

// A size of 0 follows from the other one and the aspect ratio.
void keep_aspect(const Window& old, Window& now) {
    if (now.width == 0 && now.height != 0)
        now.width = rounded(float(now.height) * float(old.width) / float(old.height));
    else if (now.height == 0 && now.width != 0)
        now.height = rounded(float(now.width) * float(old.height) / float(old.width));
}

// `end` is the end of the text that was parsed.
Found parse(const char* text, const Window& old, Window& now, int& end) {
    int right = 0, bottom = 0;
    float x = 1, y = 1;
    if (std::sscanf(text, "%d,%d,%d,%d%n", &now.x, &now.y, &right, &bottom, &end) == 4) {
        now.width = std::max(0, right - now.x + 1);
        now.height = std::max(0, bottom - now.y + 1);
        return Found::Sized;
    }
    now = old;
    Window origin = old;
    if (std::sscanf(text, "%dx%d%n%d%d%n", &now.width, &now.height, &end, &origin.x, &origin.y,
                    &end) >= 2) {
        keep_aspect(old, now);
        const bool moved = std::sscanf(text, "%*dx%*d%d%d", &right, &bottom) == 2;
        now.x = moved ? origin.x : old.x;
        now.y = moved ? origin.y : old.y;
        return Found::Sized;
    }
    now = old;
    if (std::sscanf(text, "%f%%x%f%%%n", &x, &y, &end) == 2) {
        x = x == 0 && y != 0 ? y : x;
        y = y == 0 && x != 0 ? x : y;
        now.width = rounded(float(old.width) * std::max(0.0F, x * 0.01F));
        now.height = rounded(float(old.height) * std::max(0.0F, y * 0.01F));
        return Found::Scaled;
    }
    if (std::sscanf(text, "%d%d%n", &now.x, &now.y, &end) == 2)
        return Found::Origin;
    now = old;
    if (std::sscanf(text, "%f%n%%%n", &x, &end, &end) == 1) {
        const float scale = text[end - 1] == '%' ? x * 0.01F : x;
        now.width = rounded(float(old.width) * scale);
        now.height = rounded(float(old.height) * scale);
        return Found::Scaled;
    }
    return Found::Nothing;
}

std::string valid_geometry(Geometry allowed) {
    return allowed == Geometry::Position ? "+X+Y"
           : allowed == Geometry::Window ? "WxH, WxH+X+Y, +X+Y or XMIN,YMIN,XMAX,YMAX"
                                         : "WxH, WxH+X+Y, XMIN,YMIN,XMAX,YMAX, 50% or 0.5";
}

} // namespace

Adjusted adjust_window(const std::string& text, Geometry allowed, OIIO::ROI& window, bool lenient) {
    const Window old{window.xbegin, window.ybegin, window.width(), window.height()};
    Window now = old;
    int end = 0;
    Found found = parse(text.c_str(), old, now, end);
    const std::string valid = lenient ? "" : " (valid: " + valid_geometry(allowed) + ")";
    if (found == Found::Nothing || !(lenient || size_t(end) == text.size()))
        return {"Unrecognized geometry \"" + text + "\"" + valid, ""};
    const bool rescales = found == Found::Scaled && allowed != Geometry::Scalable;
    const bool resizes = found == Found::Sized && allowed == Geometry::Position;
    const std::string why = rescales  ? "can't be used to rescale the size"
                            : resizes ? "can't be used to change the size, only the origin"
                                      : "";
    if (!why.empty() && !lenient)
        return {"\"" + text + "\": " + why + valid, ""};
    if (!why.empty()) {
        now.width = old.width;
        now.height = old.height;
    }
    window.xbegin = now.x;
    window.ybegin = now.y;
    window.xend = now.x + now.width;
    window.yend = now.y + now.height;
    return {"", why};
}

std::optional<Size> parsed_size(const std::string& text) {
    Size size{};
    int end = 0;
    bool found = std::sscanf(text.c_str(), "%fx%f%n", &size.width, &size.height, &end) == 2;
    return found && size_t(end) == text.size() ? std::optional<Size>(size) : std::nullopt;
}

OIIO::ImageSpec scaled_spec(OIIO::ImageSpec spec, const OIIO::ROI& display) {
    const float x = float(display.width()) / float(spec.full_width);
    const float y = float(display.height()) / float(spec.full_height);
    spec.x = display.xbegin + int(std::floor(float(spec.x - spec.full_x) * x));
    spec.y = display.ybegin + int(std::floor(float(spec.y - spec.full_y) * y));
    spec.width = int(std::ceil(float(spec.width) * x));
    spec.height = int(std::ceil(float(spec.height) * y));
    spec.full_x = display.xbegin;
    spec.full_y = display.ybegin;
    spec.full_width = display.width();
    spec.full_height = display.height();
    return spec;
}

} // namespace tonetool::chain
