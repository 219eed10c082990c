// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/colormap.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <utility>

#include "chain/language/values.h"
#include "imagebuf/pixels/canvas.h"
#include "imagebuf/pixels/upright.h"
#include "text/error.h"
#include "tonetool/display.h"

namespace tonetool::chain {

namespace {

bool is_list(const std::string& map) {
    return map.find(',') != std::string::npos;
}

std::vector<float> knots_of(const std::string& list) {
    std::vector<float> knots;
    for (const std::string& word : split(list, ','))
        knots.push_back(static_cast<float>(checked_number("colour", word, {-1e6, 1e6})));
    if (knots.size() < 6 || knots.size() % 3 != 0) {
        throw CommandError("\"" + list + "\" has " + std::to_string(knots.size()) +
                           " numbers (valid: two or more RGB triples)");
    }
    return knots;
}

} // namespace

void check_colormap(const std::string& map) {
    if (is_list(map))
        knots_of(map);
    else
        check_choice("colour map", map, ToneAlgo::color_maps());
}

OIIO::ImageBuf colored(const OIIO::ImageBuf& pixels, const std::string& map) {
    check_colormap(map);
    const int channel = pixels.nchannels() < 3 ? 0 : -1;
    OIIO::ImageBuf result;
    const bool done = is_list(map) ? ToneAlgo::color_map(result, pixels, knots_of(map), channel)
                                   : ToneAlgo::color_map(result, pixels, map, channel);
    if (!done)
        throw CommandError(result.geterror());
    lie_as(pixels.spec(), result);
    return result;
}

OIIO::ImageBuf colored_with_bar(const OIIO::ImageBuf& pixels, const std::string& map) {
    OIIO::ImageBuf picture = upright(colored(pixels, map), orientation_of(pixels.spec()));
    const OIIO::ROI roi = picture.roi();
    const int text = std::clamp(roi.height() / 20, 10, 32), margin = text / 2;
    const int height = std::max(roi.height(), 2 * text + margin);
    Canvas canvas(roi.width() + 2 * margin + bar_width(text), height, font_of_labels());
    canvas.paste(picture, 0, 0);
    const OIIO::ImageBuf bar = colored(ramp_of_values(text, height, true), map);
    draw_bar(canvas, bar, roi.width() + margin, 0, text);
    return std::move(canvas.image());
}

OIIO::ImageBuf linear_colored(const OIIO::ImageBuf& pixels, const std::string& map) {
    std::vector<float> knots;
    if (!is_list(map))
        return OIIO::ImageBufAlgo::color_map(pixels, -1, map);
    OIIO::Strutil::extract_from_list_string(knots, map);
    return OIIO::ImageBufAlgo::color_map(pixels, -1, int(knots.size()) / 3, 3, knots);
}

} // namespace tonetool::chain
