// SPDX-License-Identifier: BSD-3-Clause
// A sheet on which pictures, frames and text are laid out. Header only: the rooms below the
// library's draw sheets, too.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "imagebuf/pixels/label_font.h"

namespace tonetool {

using SheetColor = std::array<float, 3>;
struct SheetColors {
    SheetColor background, ink;
};
inline constexpr SheetColors kDarkSheet{{0.13f, 0.13f, 0.13f}, {0.9f, 0.9f, 0.9f}};
inline constexpr SheetColors kWhiteSheet{{1, 1, 1}, {0, 0, 0}};

/// R, G, B, sRGB-encoded. Throws a runtime_error where something cannot be drawn.
class Canvas {
public:
    /// An empty `font` leaves all text out.
    Canvas(int width, int height, const std::string& font,
           OIIO::TypeDesc format = OIIO::TypeDesc::FLOAT, const SheetColors& colors = kDarkSheet)
        : m_image(spec_of(width, height, format)),
          m_font(font),
          m_colors(colors) {
        check(OIIO::ImageBufAlgo::fill(m_image, colors.background));
    }

    void paste(const OIIO::ImageBuf& picture, int x, int y) {
        check(OIIO::ImageBufAlgo::paste(m_image, x, y, 0, 0, picture));
    }

    void rectangle(int x, int y, int width, int height, const SheetColor& color) {
        check(OIIO::ImageBufAlgo::fill(m_image, color, OIIO::ROI(x, x + width, y, y + height)));
    }

    /// A frame of this thickness around the rectangle.
    void frame(int x, int y, int width, int height, int thick, const SheetColor& color) {
        rectangle(x - thick, y - thick, width + 2 * thick, thick, color);
        rectangle(x - thick, y + height, width + 2 * thick, thick, color);
        rectangle(x - thick, y, thick, height, color);
        rectangle(x + width, y, thick, height, color);
    }

    void write(int x, int y, const std::string& text, int size,
               OIIO::ImageBufAlgo::TextAlignX align = OIIO::ImageBufAlgo::TextAlignX::Left,
               OIIO::ImageBufAlgo::TextAlignY above = OIIO::ImageBufAlgo::TextAlignY::Top,
               const std::optional<SheetColor>& color = {}) {
        if (m_font.empty() || text.empty())
            return;
        if (!OIIO::ImageBufAlgo::render_text(m_image, x, y, text, size, m_font,
                                             color.value_or(m_colors.ink), align, above)) {
            (void)m_image.geterror();
            m_font.clear();
        }
    }

    const SheetColors& colors() const { return m_colors; }
    bool labelled() const { return !m_font.empty(); }
    OIIO::ImageBuf& image() { return m_image; }

private:
    static OIIO::ImageSpec spec_of(int width, int height, OIIO::TypeDesc format) {
        OIIO::ImageSpec spec(width, height, 3, format);
        spec.attribute("oiio:ColorSpace", "sRGB");
        return spec;
    }
    void check(bool done) const {
        if (!done)
            throw std::runtime_error(m_image.geterror());
    }

    OIIO::ImageBuf m_image;
    std::string m_font;
    SheetColors m_colors;
};

/// Values from 0 to 1, from left to right or, for a bar that stands, from below.
inline OIIO::ImageBuf ramp_of_values(int width, int height, bool stands) {
    OIIO::ImageBuf ramp(OIIO::ImageSpec(width, height, 1, OIIO::TypeDesc::FLOAT));
    const float low[1] = {0.0f}, high[1] = {1.0f};
    if (stands)
        OIIO::ImageBufAlgo::fill(ramp, high, low);
    else
        OIIO::ImageBufAlgo::fill(ramp, low, high, low, high);
    return ramp;
}

/// The width of a standing bar with its numbers.
inline int bar_width(int text) {
    return text + text / 3 + 3 * text;
}

/// A standing bar of colours, those of ramp_of_values(text, height, true), from 0 to 1 with ticks
/// and numbers at the right.
inline void draw_bar(Canvas& canvas, const OIIO::ImageBuf& colors, int x, int y, int text) {
    using OIIO::ImageBufAlgo::TextAlignY;
    const int height = colors.roi().height(), steps = height >= 10 * text  ? 4
                                                      : height >= 5 * text ? 2
                                                                           : 1;
    canvas.paste(colors, x, y);
    for (int i = 0; i <= steps; ++i) {
        const int at = y + (height - 1) * (steps - i) / steps;
        canvas.rectangle(x + text, at, text / 3, 1, canvas.colors().ink);
        const TextAlignY align = i == 0       ? TextAlignY::Bottom
                                 : i == steps ? TextAlignY::Top
                                              : TextAlignY::Center;
        canvas.write(x + text + text / 2, at, OIIO::Strutil::fmt::format("{:g}", double(i) / steps),
                     text, OIIO::ImageBufAlgo::TextAlignX::Left, align);
    }
}

} // namespace tonetool
