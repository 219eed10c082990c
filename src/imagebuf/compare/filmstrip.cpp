// SPDX-License-Identifier: BSD-3-Clause
// Figure 1 of the HDR-FLIP paper as one image.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "imagebuf/pixels/canvas.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/label_font.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "imagebuf/pixels/upright.h"
#include "metrics/refusal.h"
#include "tonetool/display.h"
#include "tonetool/flip.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;
using ToneAlgo::FilmstripOptions;
namespace IBA = OIIO::ImageBufAlgo;

constexpr double kMostPixels = 1 << 28;

std::string find_font(const std::string& asked) {
    if (asked.empty())
        return label_font_file();
    return OIIO::Filesystem::is_regular(asked) ? asked : "";
}

// Where everything goes, in pixels.
struct Layout {
    int columns, thumb_w, thumb_h, margin, text, label_w;
    int wide_w, wide_h; // the two maps at the right

    Layout(int n, int width, double aspect)
        : columns(n),
          thumb_w(width),
          thumb_h(std::max(1, int(std::lround(width / aspect)))),
          margin(std::max(2, width / 30)),
          text(std::max(8, width / 14)),
          label_w(text * 6) {
        // Two maps, each under its own line of text and above its legend, beside three pictures.
        const int height = 3 * thumb_h + 2 * margin;
        wide_h = std::max(1, (height - 3 * row_gap() - text / 2) / 2);
        wide_w = std::max(1, int(std::lround(wide_h * aspect)));
    }
    int row_gap() const { return text + text / 2 + margin; }
    int left() const { return margin + label_w; }
    int top() const { return margin + row_gap(); }
    int column_x(int i) const { return left() + i * (thumb_w + margin); }
    int row_y(int i) const { return top() + i * (thumb_h + margin); }
    int wide_x() const { return column_x(columns) + margin; }
    int wide_y(int i) const { return top() + i * (wide_h + 2 * row_gap()); }
    int width() const { return wide_x() + std::max(wide_w, text * 16) + margin; }
    int height() const { return std::max(row_y(3), wide_y(1) + wide_h + row_gap()) + margin; }
};

// The display window of an image alone, upright, at the origin, `width` x `height`.
ImageBuf thumbnail(const ImageBuf& image, int orientation, int width, int height, int nthreads) {
    ImageBuf shown = upright(IBA::crop(image, image.roi_full(), nthreads), orientation);
    shown.set_origin(0, 0);
    ROI full = shown.roi();
    shown.set_roi_full(full);
    ROI target(0, width, 0, height, 0, 1, 0, shown.nchannels());
    ImageBuf out;
    if (!oiio::resize(out, shown, "", target, nthreads))
        throw std::runtime_error(out.geterror());
    return out;
}

ImageBuf encoded(const ImageBuf& linear) {
    ImageBuf out;
    if (!ToneAlgo::encode_srgb(out, linear))
        throw std::runtime_error(out.geterror());
    return out;
}

ImageBuf colored(const ImageBuf& map, const char* name, float scale = 1.0f) {
    ImageBuf out;
    if (!ToneAlgo::color_map(out, IBA::mul(map, scale), name))
        throw std::runtime_error(out.geterror());
    return out;
}

// A bar of the colours from 0 to 1.
ImageBuf legend(const char* name, int width, int height) {
    return colored(ramp_of_values(width, height, false), name);
}

class Filmstrip {
public:
    Filmstrip(const ImageBuf& reference, const ImageBuf& test, const HdrFlipOptions& options,
              const FilmstripOptions& look, int nthreads)
        : m_reference(reference),
          m_test(test),
          m_options(options),
          m_look(look),
          m_orientation(orientation_of(reference.spec())),
          m_nthreads(nthreads) {
        m_options.want_exposure_map = true;
        m_options.want_exposures = false;
    }

    ImageBuf draw(FlipResult& result) {
        ImageBuf map;
        if (!ToneAlgo::hdr_flip(map, m_reference, m_test, m_options, &result, {}, m_nthreads))
            throw std::runtime_error(map.geterror());
        const std::string font = find_font(m_look.font);
        if (font.empty())
            result.summary.warnings.emplace_back(m_look.font.empty()
                                                     ? "no font found: the filmstrip has no labels"
                                                     : "no font file \"" + m_look.font +
                                                           "\": the filmstrip has no labels");
        const auto shown = choose(result.summary.exposures);
        const ROI full = m_reference.roi_full();
        const double aspect = double(full.width()) / full.height();
        const Layout layout(int(shown.size()), m_look.thumb_width,
                            lies_on_its_side(m_orientation) ? 1 / aspect : aspect);
        if (double(layout.width()) * layout.height() > kMostPixels)
            throw std::runtime_error(format("the picture would have {}x{} pixels; pass a smaller "
                                            "width",
                                            layout.width(), layout.height()));
        Canvas canvas(layout.width(), layout.height(), font);
        row_labels(canvas, layout);
        for (size_t i = 0; i < shown.size(); ++i)
            column(canvas, layout, int(i), shown[i]);
        maps(canvas, layout, map, result);
        return std::move(canvas.image());
    }

private:
    // The first, the last, and evenly spaced ones between them.
    std::vector<double> choose(const std::vector<double>& exposures) const {
        const size_t n = exposures.size();
        const size_t count = std::min(n, size_t(m_look.max_columns));
        std::vector<double> out;
        for (size_t i = 0; i < count; ++i)
            out.push_back(
                exposures[count == 1 ? 0 : (i * (n - 1) + (count - 1) / 2) / (count - 1)]);
        return out;
    }

    static void row_labels(Canvas& canvas, const Layout& layout) {
        const char* names[3] = {"Reference", "Test", "LDR-FLIP"};
        for (int i = 0; i < 3; ++i)
            canvas.write(layout.margin, layout.row_y(i) + layout.thumb_h / 2 - layout.text / 2,
                         names[i], layout.text);
        canvas.write(layout.margin, layout.margin, "Exposure", layout.text);
    }

    // One exposure, compared alone so that only its own pictures are in memory.
    void column(Canvas& canvas, const Layout& layout, int i, double stops) const {
        HdrFlipOptions one = m_options;
        one.start_exposure = one.stop_exposure = stops;
        one.num_exposures = 1;
        one.want_exposure_map = false;
        one.want_exposures = true;
        FlipResult result;
        ImageBuf map;
        if (!ToneAlgo::hdr_flip(map, m_reference, m_test, one, &result, {}, m_nthreads))
            throw std::runtime_error(map.geterror());
        const FlipExposure& pictures = result.exposures[0];
        const auto show = [&](const ImageBuf& image) {
            return thumbnail(image, m_orientation, layout.thumb_w, layout.thumb_h, m_nthreads);
        };
        const int x = layout.column_x(i);
        canvas.write(x + layout.thumb_w / 2, layout.margin, format("{:+.1f}", stops), layout.text,
                     IBA::TextAlignX::Center);
        canvas.paste(encoded(show(pictures.reference)), x, layout.row_y(0));
        canvas.paste(encoded(show(pictures.test)), x, layout.row_y(1));
        canvas.paste(colored(show(pictures.flip), "magma"), x, layout.row_y(2));
    }

    void maps(Canvas& canvas, const Layout& layout, const ImageBuf& map,
              const FlipResult& result) const {
        const auto& exposures = result.summary.exposures;
        const auto last = float(std::max<size_t>(exposures.size() - 1, 1));
        wide(canvas, layout, 0, map, "magma", 1.0f,
             format("HDR-FLIP   mean {:.4f}", result.summary.pool.mean), "0", "1");
        wide(canvas, layout, 1, result.exposure_index, "viridis", 1.0f / last,
             "Exposure of the largest error", format("{:+.1f}", exposures.front()),
             format("{:+.1f} stops", exposures.back()));
    }

    void wide(Canvas& canvas, const Layout& l, int i, const ImageBuf& map, const char* colors,
              float scale, const std::string& title, const std::string& low,
              const std::string& high) const {
        const int x = l.wide_x(), y = l.wide_y(i), bar = y + l.wide_h + l.margin;
        const int bar_w = std::max(l.wide_w - l.text * 9, l.text * 3), bar_x = x + l.text * 3;
        canvas.write(x, y - l.row_gap(), title, l.text);
        const ImageBuf shown = thumbnail(map, m_orientation, l.wide_w, l.wide_h, m_nthreads);
        canvas.paste(colored(shown, colors, scale), x, y);
        canvas.write(bar_x - l.text / 2, bar, low, l.text, IBA::TextAlignX::Right);
        canvas.paste(legend(colors, bar_w, l.text), bar_x, bar);
        canvas.write(bar_x + bar_w + l.text / 2, bar, high, l.text);
    }

    const ImageBuf& m_reference;
    const ImageBuf& m_test;
    HdrFlipOptions m_options;
    FilmstripOptions m_look;
    int m_orientation;
    int m_nthreads;
};

std::string look_fault(const FilmstripOptions& look) {
    if (look.thumb_width < 32 || look.thumb_width > 4096)
        return format("width is {}: must be 32 to 4096 pixels", look.thumb_width);
    if (look.max_columns < 1)
        return format("columns is {}: must be at least 1", look.max_columns);
    return {};
}

} // namespace

namespace ToneAlgo {

bool flip_filmstrip(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
                    const HdrFlipOptions& options, const FilmstripOptions& look, FlipResult* result,
                    int nthreads) {
    return guarded(dst, "flip_filmstrip", [&] {
        if (const std::string why = look_fault(look); !why.empty())
            throw Refusal(why);
        FlipResult own;
        dst = Filmstrip(reference, test, options, look, nthreads).draw(result ? *result : own);
    });
}

} // namespace ToneAlgo
} // namespace tonetool
