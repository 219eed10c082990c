// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/fitting.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <numeric>

#include "chain/images/channels.h"
#include "imagebuf/pixels/float_rows.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "text/error.h"
#include "tonetool/pixels.h"

namespace tonetool::chain {

namespace {

// The most channels that the format takes; 0: any number.
int most_channels(const OIIO::ImageSpec& spec, const OIIO::ImageOutput& writer) {
    const bool alpha = oiio::format_supports(writer, "alpha");
    const bool fits = spec.nchannels <= 3 || (spec.nchannels == 4 && alpha) ||
                      (spec.nchannels > 4 && oiio::format_supports(writer, "nchannels"));
    return fits ? 0 : alpha ? 4 : 3;
}

// oiiotool's choice: plain R, G, B and A, else the first ones.
std::vector<int> usual_channels(const OIIO::ImageSpec& spec, int kept) {
    static const char* const usual[] = {"R", "G", "B", "A"};
    std::vector<int> chosen;
    for (int i = 0; i < kept; ++i)
        chosen.push_back(channel_index(spec, usual[i]));
    if (std::find(chosen.begin(), chosen.end(), -1) != chosen.end())
        std::iota(chosen.begin(), chosen.end(), 0);
    return chosen;
}

// In formats without channel names the fourth channel (or the second of two) is read as alpha. TIFF
// is none of them: it stores which channel is alpha.
bool tells_channels_apart(const OIIO::ImageOutput& writer) {
    const std::string format = writer.format_name();
    return format == "openexr" || format == "tiff" || format == "null" || format == "zfile";
}

bool is_alpha(const OIIO::ImageSpec& spec, int channel) {
    const std::string name(spec.channel_name(channel));
    const std::string last = name.substr(name.rfind('.') + 1); // npos + 1 is 0
    return channel == spec.alpha_channel || OIIO::Strutil::iequals(last, "a") ||
           OIIO::Strutil::iequals(last, "alpha");
}

// The displayed layer and its alpha: the tone-mapped one, else the beauty.
bool find_shown(const OIIO::ImageSpec& spec, ColorChoice& choice, bool& mapped) {
    PixelOptions options;
    options.from = "rec709"; // it is not looked at
    std::string ignored;
    const OIIO::ParamValue* layer = spec.find_attribute("tonemap:layer");
    options.layer = layer ? layer->get_string() : "";
    mapped = layer && ToneAlgo::find_color(spec, options, choice, ignored);
    options.layer.clear();
    return mapped || ToneAlgo::find_color(spec, options, choice, ignored);
}

// The channels of the displayed layer, else the first ones; `mapped`: they were tone mapped.
std::vector<int> picture_channels(const OIIO::ImageSpec& spec, int most, bool& mapped) {
    ColorChoice choice;
    const bool found = find_shown(spec, choice, mapped);
    std::vector<int> chosen(size_t((found ? choice.grey() : spec.nchannels < 3) ? 1 : 3));
    std::iota(chosen.begin(), chosen.end(), 0);
    if (found) {
        const int colors[3] = {choice.r, choice.g, choice.b};
        std::copy_n(colors, chosen.size(), chosen.begin());
    }
    const int next = int(chosen.size());
    const bool first_alpha = !found && next < spec.nchannels && is_alpha(spec, next);
    if (choice.a >= 0 || first_alpha)
        chosen.push_back(first_alpha ? next : choice.a);
    chosen.resize(std::min(chosen.size(), size_t(most)));
    return chosen;
}

// A channel that a file for a screen would read as alpha is one.
bool is_safe(const OIIO::ImageSpec& spec, const OIIO::ImageOutput& writer) {
    const bool with_alpha = spec.nchannels == 2 || spec.nchannels >= 4;
    const bool alpha = oiio::format_supports(writer, "alpha");
    return tells_channels_apart(writer) || !alpha || !with_alpha ||
           is_alpha(spec, spec.nchannels == 2 ? 1 : 3);
}

bool holds_floats(const OIIO::ImageOutput& writer) {
    static const Strings formats = {"openexr", "tiff", "fits", "rla", "zfile", "null"};
    return std::find(formats.begin(), formats.end(), writer.format_name()) != formats.end();
}

// The part of the window at x, y >= 0; one pixel if that is empty.
OIIO::ROI not_negative(OIIO::ROI window) {
    window.xbegin = std::max(window.xbegin, 0);
    window.ybegin = std::max(window.ybegin, 0);
    window.xend = std::max(window.xend, window.xbegin + 1);
    window.yend = std::max(window.yend, window.ybegin + 1);
    return window;
}

} // namespace

bool fit_windows(const OIIO::ImageBuf& image, const OIIO::ImageOutput& writer, bool lenient,
                 OIIO::ImageBuf& fitted) {
    const bool windows = oiio::format_supports(writer, "displaywindow");
    const bool origins = oiio::format_supports(writer, "negativeorigin");
    const OIIO::ROI data = image.roi();
    OIIO::ROI display = image.roi_full();
    display.chend = image.nchannels();
    const bool below_zero =
        std::min({data.xbegin, data.ybegin, display.xbegin, display.ybegin}) < 0;
    OIIO::ROI wanted = windows ? data : display;
    bool moves = false;
    if (below_zero && !origins && lenient) {
        wanted = not_negative(wanted);
    } else if (below_zero && !origins) {
        wanted = display;
        moves = std::min(display.xbegin, display.ybegin) < 0;
    }
    if (image.deep() || (wanted == data && !moves))
        return false;
    fitted = OIIO::ImageBufAlgo::crop(image, wanted);
    if (fitted.has_error())
        throw CommandError(fitted.geterror());
    if (moves) {
        fitted.set_origin(0, 0);
        OIIO::ROI whole = fitted.roi();
        fitted.set_roi_full(whole);
    }
    return true;
}

void fit_channels(Outgoing& image, const OIIO::ImageOutput& writer, const Writer& from) {
    const OIIO::ImageSpec& spec = image.pixels->spec();
    const int most = most_channels(spec, writer);
    const bool lenient = from.lenient && !spec.find_attribute("tonemap:layer");
    if (spec.deep || (most == 0 && (lenient || is_safe(spec, writer))))
        return;
    bool mapped = false;
    const std::vector<int> chosen =
        lenient ? usual_channels(spec, most)
                : picture_channels(spec, oiio::format_supports(writer, "alpha") ? 4 : 3, mapped);
    Strings names;
    for (int index : chosen)
        names.push_back(std::string(spec.channel_name(index)));
    // The tone-mapped layer is the one to be seen.
    if (!mapped) {
        from.warn("Can't save " + std::to_string(spec.nchannels) + " channels to " +
                  writer.format_name() + "... saving only " + join(names, ","));
    }
    OIIO::ImageBuf fitted = OIIO::ImageBufAlgo::channels(*image.pixels, int(chosen.size()), chosen);
    if (fitted.has_error())
        throw CommandError(fitted.geterror());
    image.owned = std::move(fitted);
    image.pixels = &image.owned;
    image.format.of_channel.clear();
}

void mark_alpha(OIIO::ImageSpec& spec) {
    const int last = spec.nchannels - 1;
    if (spec.alpha_channel < 0 && (last == 1 || last == 3) && is_alpha(spec, last))
        spec.alpha_channel = last;
}

void warn_of_unseen(const Warn& warn, const OIIO::ImageBuf& pixels, const OIIO::ImageSpec& written,
                    const OIIO::ImageOutput& writer) {
    constexpr double share = 0.01; // share of the non-black pixels: fewer are glints on an edge
    const OIIO::ImageSpec& spec = pixels.spec();
    const int alpha = spec.nchannels - 1;
    const bool integers = !written.format.is_floating_point() || !holds_floats(writer);
    const bool screen = oiio::format_supports(writer, "alpha") && integers;
    if (!screen || spec.deep || spec.depth > 1 || (alpha != 1 && alpha != 3) ||
        !is_alpha(spec, alpha))
        return;
    int64_t lit = 0, unseen = 0;
    for_each_row(pixels, pixels.roi(), [&](int /*y*/, const float* pixel) {
        for (int x = 0; x < spec.width; ++x, pixel += spec.nchannels) {
            const bool light =
                std::any_of(pixel, pixel + alpha, [](float value) { return value > 0; });
            lit += light;
            unseen += light && pixel[alpha] <= 0;
        }
    });
    if (double(unseen) > share * double(lit)) {
        warn("alpha is 0 in " + std::to_string(unseen) + " of the " + std::to_string(lit) +
             " pixels that have a colour: viewers that heed alpha do not show them");
    }
}

} // namespace tonetool::chain
