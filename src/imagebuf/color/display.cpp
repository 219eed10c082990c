// SPDX-License-Identifier: BSD-3-Clause
// The public functions of include/tonetool/display.h.
#include "tonetool/display.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/pixels/colorimetry.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/names.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/planes.h"
#include "imagebuf/pixels/row_source.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
namespace IBA = OIIO::ImageBufAlgo;

// Every value of a float image but those of one channel becomes map(value).
template <class Map>
void map_values(ImageBuf& image, int but, int nthreads, const Map& map) {
    const int channels = image.nchannels();
    const int64_t row = int64_t(image.spec().width) * channels;
    auto* pixels = static_cast<float*>(image.localpixels());
    make_parallel(nthreads)(image.spec().height, [=](int64_t y) {
        for (int64_t i = 0; i < row; ++i)
            if (i % channels != but)
                pixels[y * row + i] = map(pixels[y * row + i]);
    });
}

// Within [0,1], NaN as 0.
float unit_value(float v) {
    return std::isnan(v) ? 0.0f : std::clamp(v, 0.0f, 1.0f);
}

ImageBuf copy_part(const ImageBuf& src, ROI roi, int nthreads) {
    return copy_pixels(src, part_of(src, roi), nthreads);
}

void encode_pixels(ImageBuf& image, int nthreads) {
    map_values(image, image.spec().alpha_channel, nthreads,
               [](float v) { return float(linear_to_srgb(double(unit_value(v)))); });
    retag(image.specmod(), "sRGB");
}

// An image whose space nobody knows is taken as it is.
bool is_encoded(const ImageBuf& image) {
    try {
        return find_space(deciding_spec(image), "").encoded();
    } catch (const Refusal&) {
        return false;
    }
}

void check_linear(const ImageBuf& image) {
    if (is_encoded(image))
        throw Refusal(side_name("source", image) + "is sRGB-encoded already");
}

void encode(ImageBuf& dst, const ImageBuf& src, ROI roi, int nthreads) {
    check_readable(src, "source");
    check_linear(src);
    ImageBuf out = copy_part(src, roi, nthreads);
    encode_pixels(out, nthreads);
    dst = std::move(out);
}

// `map(out, values)` colours values within [0,1] in linear light.
template <class Map>
void colored(ImageBuf& dst, const ImageBuf& src, int channel, ROI roi, int nthreads,
             const Map& map) {
    check_readable(src, "source");
    if (channel < -1 || channel >= src.nchannels() || (channel == -1 && src.nchannels() < 3))
        throw Refusal(OIIO::Strutil::fmt::format("needs channel {}; the image has {}", channel,
                                                 src.nchannels()));
    ImageBuf linear, values = copy_part(src, roi, nthreads);
    map_values(values, -1, nthreads, unit_value);
    if (!map(linear, values))
        throw Refusal(linear.geterror());
    linear.set_roi_full(src.roi_full());
    OIIO::ImageSpec& spec = linear.specmod();
    spec.channelnames = {"R", "G", "B"};
    spec.alpha_channel = spec.z_channel = -1;
    spec.erase_attribute("chromaticities");
    encode_pixels(linear, nthreads);
    dst = std::move(linear);
}

} // namespace

namespace ToneAlgo {

bool color_map(ImageBuf& dst, const ImageBuf& src, const std::string& map, int channel, ROI roi,
               int nthreads) {
    return guarded(dst, "color_map", [&] {
        const auto names = color_maps();
        if (std::find(names.begin(), names.end(), map) == names.end())
            throw Refusal(unknown_name("colour map", map, names));
        colored(dst, src, channel, roi, nthreads, [&](ImageBuf& out, const ImageBuf& values) {
            return IBA::color_map(out, values, channel, map, {}, nthreads);
        });
    });
}

bool color_map(ImageBuf& dst, const ImageBuf& src, const std::vector<float>& triples, int channel,
               ROI roi, int nthreads) {
    return guarded(dst, "color_map", [&] {
        if (triples.size() < 6 || triples.size() % 3 != 0)
            throw Refusal(std::to_string(triples.size()) +
                          " numbers: must be two or more RGB triples");
        colored(dst, src, channel, roi, nthreads, [&](ImageBuf& out, const ImageBuf& values) {
            return IBA::color_map(out, values, channel, int(triples.size() / 3), 3, triples, {},
                                  nthreads);
        });
    });
}

std::vector<std::string> color_maps() {
    return {"magma", "viridis", "inferno", "plasma", "turbo", "blue-red", "spectrum", "heat"};
}

bool encode_srgb(ImageBuf& dst, const ImageBuf& src, ROI roi, int nthreads) {
    return guarded(dst, "encode_srgb", [&] { encode(dst, src, roi, nthreads); });
}

} // namespace ToneAlgo
} // namespace tonetool
