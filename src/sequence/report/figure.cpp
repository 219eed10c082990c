// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/figure.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "imagebuf/pixels/canvas.h"
#include "sequence/report/bytes.h"
#include "sequence/report/encoded.h"
#include "sequence/report/reduced.h"
#include "text/printable.h"
#include "text/text.h"

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;
using TextAlignX = OIIO::ImageBufAlgo::TextAlignX;
using TextAlignY = OIIO::ImageBufAlgo::TextAlignY;

constexpr double kMostFigurePixels = 1 << 28;
constexpr int kGap = 4, kSpace = 12;
// Of Okabe and Ito, which colour-blind readers tell apart.
constexpr std::array<SheetColor, 6> kInsetColors{{{0.90f, 0.62f, 0.00f},
                                                  {0.34f, 0.71f, 0.91f},
                                                  {0.00f, 0.62f, 0.45f},
                                                  {0.94f, 0.89f, 0.26f},
                                                  {0.84f, 0.37f, 0.00f},
                                                  {0.80f, 0.47f, 0.65f}}};
constexpr SheetColor kNothingDark{0.05f, 0.05f, 0.05f}, kNothingWhite{0.9f, 0.9f, 0.9f};

// ---- a case as text

struct FigureCase {
    std::string stops, reference, test, error; ///< pictures as data URIs
    int x = 0, y = 0, width = 0, height = 0;
};

FigureCase figure_case(const std::string& text) {
    const Strings parts = split(text, '\n');
    FigureCase found;
    if (parts.size() != 8)
        return found;
    found.stops = parts[0];
    found.x = parse_integer(parts[1]).value_or(0);
    found.y = parse_integer(parts[2]).value_or(0);
    found.width = parse_integer(parts[3]).value_or(0);
    found.height = parse_integer(parts[4]).value_or(0);
    found.reference = parts[5];
    found.test = parts[6];
    found.error = parts[7];
    return found;
}

// ---- what stands where

struct FigureRow {
    Item item; ///< without a method
    const FrameResult* any = nullptr;
    std::map<std::string, const FrameResult*> frames; ///< by method
    std::map<std::string, FigureCase> cases;
    std::string reference, stops;
    std::vector<ROI> parts; ///< of the pictures, counted from their first pixel
    int width = 0, height = 0;
};

std::vector<std::string> in_order(const std::vector<std::string>& asked,
                                  const std::set<std::string>& there) {
    return asked.empty() ? std::vector<std::string>(there.begin(), there.end()) : asked;
}

ROI part_of_inset(const Inset& inset, const FigureCase& of, const std::string& name) {
    const ROI part(inset.x - of.x, inset.x - of.x + inset.width, inset.y - of.y,
                   inset.y - of.y + inset.height);
    if (part.xbegin < 0 || part.ybegin < 0 || part.xend > of.width || part.yend > of.height) {
        throw std::runtime_error(format("inset {} is not inside of {}, which is {}",
                                        window_text({inset.x, inset.y, inset.width, inset.height}),
                                        name, window_text({of.x, of.y, of.width, of.height})));
    }
    return part;
}

ImageBuf cut_and_repeated(const ImageBuf& picture, const ROI& part, int scale) {
    const int width = part.width() * scale, height = part.height() * scale;
    std::vector<unsigned char> from(size_t(part.width()) * size_t(part.height()) * 3),
        to(size_t(width) * size_t(height) * 3);
    ROI pixels = part;
    pixels.chend = 3;
    if (!picture.get_pixels(pixels, OIIO::TypeDesc::UINT8, from.data()))
        throw std::runtime_error(picture.geterror());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t at = 3 * (size_t(y / scale) * size_t(part.width()) + size_t(x / scale));
            std::copy_n(&from[at], 3, &to[3 * (size_t(y) * size_t(width) + size_t(x))]);
        }
    ImageBuf result(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8));
    if (!result.set_pixels(result.roi(), OIIO::TypeDesc::UINT8, to.data()))
        throw std::runtime_error(result.geterror());
    return result;
}

// As much of the text as has room.
std::string shortened(std::string text, int height, int room) {
    const auto width = [&] {
        const ROI size = OIIO::ImageBufAlgo::text_size(text, height, font_of_labels());
        return size.defined() ? size.width() : 0;
    };
    bool whole = true;
    while (text.size() > 4 && width() > room) {
        size_t end = text.size() - std::min<size_t>(whole ? 1 : 4, text.size());
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
            --end;
        text.replace(end, std::string::npos, "...");
        whole = false;
    }
    return text;
}

class Figure {
public:
    Figure(const ShotResult& shot, const PictureStore& pictures, const FigureOptions& options)
        : m_options(options),
          m_scale(options.scale > 0        ? options.scale
                  : options.insets.empty() ? 1
                                           : 4),
          m_text(options.text),
          m_line(m_text + m_text / 2) {
        collect(shot, pictures);
        for (const FigureRow& row : m_rows)
            measure(row);
    }

    ImageBuf draw(std::string& warning) {
        const int bar = m_errors ? kSpace + bar_width(m_text) : 0;
        const int width = columns_end() + bar + kSpace;
        int height = kSpace;
        for (const FigureRow& row : m_rows)
            height += row_height(row) + kSpace;
        if (double(width) * height > kMostFigurePixels)
            throw std::runtime_error(format("the figure would have {}x{} pixels (valid: fewer "
                                            "names or methods, or smaller insets)",
                                            width, height));
        Canvas canvas(width, height, font_of_labels(), OIIO::TypeDesc::UINT8,
                      m_options.dark ? kDarkSheet : kWhiteSheet);
        int y = kSpace;
        for (const FigureRow& row : m_rows) {
            draw_row(canvas, row, y);
            y += row_height(row) + kSpace;
        }
        if (m_errors) {
            const int size = std::max(cells_height(m_rows.front()), 2 * m_text);
            draw_bar(canvas, colored_bytes(ramp_of_values(m_text, size, true), "magma"),
                     columns_end() + kSpace, kSpace + head_height(), m_text);
        }
        if (!canvas.labelled())
            warning = std::string("no font \"") + kLabelFont + "\" found: the figure has no labels";
        else if (has_several_tests())
            warning =
                "of several tests of a reference the first is drawn (valid: %M in the names, for "
                "a column of each)";
        return std::move(canvas.image());
    }

private:
    bool has_several_tests() const {
        const auto several = [](const FrameResult& frame) {
            return std::any_of(frame.measurements.begin(), frame.measurements.end(),
                               [&](const Measurement& one) {
                                   return one.test != frame.measurements.front().test;
                               });
        };
        return std::any_of(m_rows.begin(), m_rows.end(), [&](const FigureRow& row) {
            return std::any_of(row.frames.begin(), row.frames.end(),
                               [&](const auto& of) { return several(*of.second); });
        });
    }

    void collect(const ShotResult& shot, const PictureStore& pictures) {
        std::set<std::string> names, methods;
        std::map<Item, FigureRow> rows;
        for (const FrameResult& frame : shot.frames) {
            Item item = frame.item();
            if (!m_options.wants(item))
                continue;
            methods.insert(item.method);
            names.insert(item.name);
            item.method.clear();
            FigureRow& row = rows[item];
            row.item = item;
            row.any = &frame;
            row.frames[frame.method] = &frame;
            if (const std::string text = pictures.figure(frame.item()); !text.empty())
                add_case(row, frame.method, figure_case(text));
        }
        m_methods = in_order(m_options.methods, methods);
        for (const std::string& name : in_order(m_options.names, names))
            for (auto& [item, row] : rows)
                if (item.name == name && row.width > 0)
                    m_rows.push_back(std::move(row));
        if (m_rows.empty())
            throw std::runtime_error("there is no pair for the figure");
        for (FigureRow& row : m_rows)
            find_parts(row);
    }

    void add_case(FigureRow& row, const std::string& method, FigureCase found) {
        if (row.width == 0) {
            row.reference = found.reference;
            row.stops = found.stops;
            row.width = found.width;
            row.height = found.height;
        }
        m_errors = m_errors || !found.error.empty();
        row.cases.emplace(method, std::move(found));
    }

    void find_parts(FigureRow& row) const {
        if (m_options.insets.empty())
            row.parts = {ROI(0, row.width, 0, row.height)};
        for (const Inset& inset : m_options.insets)
            row.parts.push_back(part_of_inset(inset, row.cases.begin()->second, title_of(row)));
    }

    static std::string title_of(const FigureRow& row) {
        return row.item.named() ? item_name(row.item) : "the image";
    }

    // The whole reference beside its insets: as high as they are, by whole factors if larger.
    std::pair<int, int> whole_size(const FigureRow& row) const {
        if (m_options.insets.empty())
            return {0, 0};
        const int height = cells_height(row);
        if (height >= row.height) {
            const int factor = std::min(height / row.height, m_scale);
            return {row.width * factor, row.height * factor};
        }
        return {std::max(1, int(std::lround(double(row.width) * height / row.height))), height};
    }

    void measure(const FigureRow& row) {
        m_left = std::max(m_left, whole_size(row).first);
        for (const ROI& part : row.parts)
            m_column = std::max({m_column, part.width() * m_scale, 7 * m_text});
    }

    // Texts beside each other stand on one line, whatever their letters.
    void write_line(Canvas& canvas, int x, int y, const std::string& text) const {
        canvas.write(x, y + m_text, text, m_text, TextAlignX::Left, TextAlignY::Baseline);
    }

    int cells_height(const FigureRow& row) const {
        int height = -kSpace;
        for (const ROI& part : row.parts)
            height += (m_errors ? 2 : 1) * part.height() * m_scale + (m_errors ? kGap : 0) + kSpace;
        return height;
    }
    // Beside the whole picture its title has a place of its own.
    int head_height() const { return m_left > 0 ? m_line : 2 * m_line; }
    int row_height(const FigureRow& row) const {
        return head_height() + cells_height(row) + kGap + m_line;
    }
    int column_x(size_t column) const {
        return kSpace + (m_left > 0 ? m_left + kSpace : 0) + int(column) * (m_column + kSpace);
    }
    int columns_end() const { return column_x(m_methods.size() + 1) - kSpace; }

    void draw_row(Canvas& canvas, const FigureRow& row, int y) const {
        const auto reference = picture_of(row.reference);
        if (!reference)
            throw std::runtime_error("the reference of " + title_of(row) + " was not drawn");
        std::string title = row.item.named() ? printable(item_name(row.item)) : "";
        if (!row.stops.empty())
            title += (title.empty() ? "" : ", ") + row.stops + " stops";
        write_line(canvas, kSpace, y,
                   shortened(title, m_text, m_left > 0 ? m_left : columns_end()));
        y += head_height();
        if (m_left > 0)
            draw_whole(canvas, row, *reference, y);
        write_line(canvas, column_x(0), y - m_line, "Reference");
        draw_column(canvas, row, 0, *reference, std::nullopt, y);
        write_line(canvas, column_x(0), y + cells_height(row) + kGap,
                   shortened(quantity_name(row), m_text, m_column));
        for (size_t i = 0; i < m_methods.size(); ++i)
            draw_method(canvas, row, i, y);
    }

    void draw_method(Canvas& canvas, const FigureRow& row, size_t i, int y) const {
        const std::string& method = m_methods[i];
        const int x = column_x(i + 1), below = y + cells_height(row) + kGap;
        write_line(canvas, x, y - m_line,
                   shortened(method.empty() ? "Test" : printable(method), m_text, m_column));
        const auto found = row.cases.find(method);
        const auto frame = row.frames.find(method);
        if (found != row.cases.end()) {
            const auto test = picture_of(found->second.test);
            const auto error = picture_of(found->second.error);
            if (!test || found->second.width != row.width || found->second.height != row.height)
                throw std::runtime_error("pictures of " + title_of(row) + " differ in size");
            draw_column(canvas, row, i + 1, *test, error, y);
            write_line(canvas, x, below, number_of_frame(*frame->second));
        } else {
            draw_column(canvas, row, i + 1, std::nullopt, std::nullopt, y);
            write_line(canvas, x, below,
                       frame == row.frames.end() ? "" : status_name(frame->second->status));
        }
    }

    static const Measurement* first_of(const FrameResult& frame) {
        const bool there =
            !frame.measurements.empty() && !frame.measurements.front().quantities.empty();
        return there ? &frame.measurements.front() : nullptr;
    }
    static std::string number_of_frame(const FrameResult& frame) {
        const Measurement* first = first_of(frame);
        return first ? format("{:.4f}", first->quantities.front().second) : "";
    }
    static std::string quantity_name(const FigureRow& row) {
        for (const auto& entry : row.frames)
            if (const Measurement* first = first_of(*entry.second))
                return first->command + " " + first->quantities.front().first;
        return "";
    }

    void draw_whole(Canvas& canvas, const FigureRow& row, const ImageBuf& reference, int y) const {
        const auto [width, height] = whole_size(row);
        const ROI all(0, row.width, 0, row.height);
        canvas.paste(width >= row.width ? cut_and_repeated(reference, all, width / row.width)
                                        : resized(reference, {width, height}),
                     kSpace, y);
        const double factor = double(width) / row.width;
        for (size_t i = 0; i < row.parts.size(); ++i) {
            const ROI& part = row.parts[i];
            const auto along = [&](int at) { return int(std::lround(at * factor)); };
            const int left = along(part.xbegin), top = along(part.ybegin);
            canvas.frame(kSpace + left, y + top, along(part.xend) - left, along(part.yend) - top, 2,
                         color_of_inset(i));
            const bool room = top >= m_text + 2; // for the number above the frame
            const int number_y = room ? y + top - m_text - 2 : y + along(part.yend) + 2;
            canvas.rectangle(kSpace + left - 2, number_y, m_text, m_text,
                             canvas.colors().background);
            canvas.write(kSpace + left + m_text / 2 - 2, number_y + m_text / 2,
                         std::to_string(i + 1), m_text - 2, TextAlignX::Center, TextAlignY::Center,
                         color_of_inset(i));
        }
    }

    static const SheetColor& color_of_inset(size_t i) {
        return kInsetColors.at(i % kInsetColors.size());
    }

    // Each part above its error map; of the reference the number of the inset stands there.
    void draw_column(Canvas& canvas, const FigureRow& row, size_t column,
                     const std::optional<ImageBuf>& picture, const std::optional<ImageBuf>& error,
                     int y) const {
        const int x = column_x(column);
        for (size_t i = 0; i < row.parts.size(); ++i) {
            const ROI& part = row.parts[i];
            const int width = part.width() * m_scale, height = part.height() * m_scale;
            cell(canvas, x, y, part, picture);
            if (!m_options.insets.empty())
                canvas.frame(x, y, width, height, 2, color_of_inset(i));
            y += height + (m_errors ? kGap : kSpace);
            if (!m_errors)
                continue;
            if (column > 0)
                cell(canvas, x, y, part, error);
            else if (!m_options.insets.empty())
                canvas.write(x, y + kGap, std::to_string(i + 1), m_text, TextAlignX::Left,
                             TextAlignY::Top, color_of_inset(i));
            y += height + kSpace;
        }
    }

    void cell(Canvas& canvas, int x, int y, const ROI& part,
              const std::optional<ImageBuf>& picture) const {
        if (picture)
            canvas.paste(cut_and_repeated(*picture, part, m_scale), x, y);
        else
            canvas.rectangle(x, y, part.width() * m_scale, part.height() * m_scale,
                             m_options.dark ? kNothingDark : kNothingWhite);
    }

    const FigureOptions& m_options;
    int m_scale, m_text, m_line;
    std::vector<FigureRow> m_rows;
    std::vector<std::string> m_methods;
    bool m_errors = false;
    int m_left = 0, m_column = 0;
};

bool is_among(const std::vector<std::string>& asked, const std::string& one) {
    return asked.empty() || std::find(asked.begin(), asked.end(), one) != asked.end();
}

} // namespace

bool FigureOptions::wants(const Item& item) const {
    return is_among(names, item.name) && is_among(methods, item.method);
}

std::optional<Inset> parse_inset(const std::string& text) {
    const size_t by = text.find('x'), first = text.find('+'),
                 second = first == std::string::npos ? first : text.find('+', first + 1);
    if (by == std::string::npos || second == std::string::npos || by > first)
        return std::nullopt;
    const auto width = parse_integer(text.substr(0, by)),
               height = parse_integer(text.substr(by + 1, first - by - 1)),
               x = parse_integer(text.substr(first + 1, second - first - 1)),
               y = parse_integer(text.substr(second + 1));
    if (!width || !height || !x || !y || *width < 1 || *height < 1)
        return std::nullopt;
    return Inset{*width, *height, *x, *y};
}

std::string figure_text(const CasePictures& pictures) {
    const auto uri = [](const ImageBuf& picture, bool there) {
        return there && picture.initialized() ? data_uri(picture, Encoding::Png) : "";
    };
    const ROI size = pictures.test.roi();
    const std::string stops = pictures.stops ? format("{:+.2f}", *pictures.stops) : "";
    return format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}", stops, pictures.x, pictures.y, size.width(),
                  size.height(), uri(pictures.reference, true), uri(pictures.test, true),
                  uri(pictures.error, pictures.bounded));
}

ImageBuf figure(const ShotResult& shot, const PictureStore& pictures, const FigureOptions& options,
                std::string& warning) {
    return Figure(shot, pictures, options).draw(warning);
}

} // namespace tonetool::sequence
