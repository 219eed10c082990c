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

bool copy_part(ImageBuf& out, const ImageBuf& src, ROI roi, int nthreads, std::string& error) {
    ROI part;
    return part_of(src, roi, part, error) && copy_pixels(out, src, part, nthreads, error);
}

void encode_pixels(ImageBuf& image, int nthreads) {
    map_values(image, image.spec().alpha_channel, nthreads,
               [](float v) { return float(linear_to_srgb(double(unit_value(v)))); });
    retag(image.specmod(), "sRGB");
}

bool is_linear(const ImageBuf& image, std::string& error) {
    ColorSpace space;
    std::string untold;
    if (!find_space(deciding_spec(image), "", space, untold) || !space.encoded())
        return true;
    error = side_name("source", image) + "is sRGB-encoded already";
    return false;
}

bool encode(ImageBuf& dst, const ImageBuf& src, ROI roi, int nthreads, std::string& error) {
    ImageBuf out;
    if (!check_readable(src, "source", error) || !is_linear(src, error) ||
        !copy_part(out, src, roi, nthreads, error))
        return false;
    encode_pixels(out, nthreads);
    dst = std::move(out);
    return true;
}

// `map(out, values)` colours values within [0,1] in linear light.
template <class Map>
bool colored(ImageBuf& dst, const ImageBuf& src, int channel, ROI roi, int nthreads,
             std::string& error, const Map& map) {
    if (!check_readable(src, "source", error))
        return false;
    if (channel < -1 || channel >= src.nchannels() || (channel == -1 && src.nchannels() < 3)) {
        error = OIIO::Strutil::fmt::format("needs channel {}; the image has {}", channel,
                                           src.nchannels());
        return false;
    }
    ImageBuf values, linear;
    if (!copy_part(values, src, roi, nthreads, error))
        return false;
    map_values(values, -1, nthreads, unit_value);
    if (!map(linear, values)) {
        error = linear.geterror();
        return false;
    }
    linear.set_roi_full(src.roi_full());
    OIIO::ImageSpec& spec = linear.specmod();
    spec.channelnames = {"R", "G", "B"};
    spec.alpha_channel = spec.z_channel = -1;
    spec.erase_attribute("chromaticities");
    encode_pixels(linear, nthreads);
    dst = std::move(linear);
    return true;
}

} // namespace

namespace ToneAlgo {

bool color_map(ImageBuf& dst, const ImageBuf& src, const std::string& map, int channel, ROI roi,
               int nthreads) {
    return guarded(dst, "color_map", [&](std::string& error) {
        const auto names = color_maps();
        if (std::find(names.begin(), names.end(), map) == names.end()) {
            error = unknown_name("colour map", map, names);
            return false;
        }
        return colored(dst, src, channel, roi, nthreads, error,
                       [&](ImageBuf& out, const ImageBuf& values) {
                           return IBA::color_map(out, values, channel, map, {}, nthreads);
                       });
    });
}

bool color_map(ImageBuf& dst, const ImageBuf& src, const std::vector<float>& triples, int channel,
               ROI roi, int nthreads) {
    return guarded(dst, "color_map", [&](std::string& error) {
        if (triples.size() < 6 || triples.size() % 3 != 0) {
            error = std::to_string(triples.size()) + " numbers: must be two or more RGB triples";
            return false;
        }
        return colored(dst, src, channel, roi, nthreads, error,
                       [&](ImageBuf& out, const ImageBuf& values) {
                           return IBA::color_map(out, values, channel, int(triples.size() / 3), 3,
                                                 triples, {}, nthreads);
                       });
    });
}

std::vector<std::string> color_maps() {
    return {"magma", "viridis", "inferno", "plasma", "turbo", "blue-red", "spectrum", "heat"};
}

bool encode_srgb(ImageBuf& dst, const ImageBuf& src, ROI roi, int nthreads) {
    return guarded(dst, "encode_srgb",
                   [&](std::string& error) { return encode(dst, src, roi, nthreads, error); });
}

} // namespace ToneAlgo
} // namespace tonetool
