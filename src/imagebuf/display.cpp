// The public functions of include/tonetool/display.h.
#include "include/tonetool/display.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/colorimetry.h"
#include "imagebuf/guard.h"
#include "imagebuf/names.h"
#include "imagebuf/parallel.h"
#include "imagebuf/planes.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
namespace IBA = OIIO::ImageBufAlgo;

// Values within [0,1], NaN as 0.
ImageBuf unit_values(const ImageBuf& src, ROI roi, int nthreads) {
    const ImageBuf part = IBA::crop(src, roi, nthreads);
    ImageBuf fixed;
    const ImageBuf clamped = IBA::clamp(part, 0.0f, 1.0f, false, {}, nthreads);
    IBA::fixNonFinite(fixed, clamped, IBA::NONFINITE_BLACK, nullptr, {}, nthreads);
    return fixed;
}

bool encode(ImageBuf& dst, const ImageBuf& src, ROI roi, int nthreads, std::string& error) {
    ImageBuf out;
    if (!check_readable(src, "source", error))
        return false;
    if (!IBA::copy(out, src, OIIO::TypeFloat, roi, nthreads)) {
        error = out.geterror();
        return false;
    }
    const int alpha = out.spec().alpha_channel, channels = out.nchannels();
    const int64_t row = int64_t(out.spec().width) * channels;
    auto* pixels = static_cast<float*>(out.localpixels());
    make_parallel(nthreads)(out.spec().height, [=](int64_t y) {
        for (int64_t i = 0; i < row; ++i)
            if (float& v = pixels[y * row + i]; i % channels != alpha)
                v = std::isnan(v) ? 0.0f : float(linear_to_srgb(std::clamp(double(v), 0.0, 1.0)));
    });
    out.specmod().attribute("oiio:ColorSpace", "sRGB");
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
    ImageBuf linear;
    if (!map(linear, unit_values(src, roi.defined() ? roi : src.roi(), nthreads))) {
        error = linear.geterror();
        return false;
    }
    linear.set_roi_full(src.roi_full());
    OIIO::ImageSpec& spec = linear.specmod();
    spec.channelnames = {"R", "G", "B"};
    spec.alpha_channel = spec.z_channel = -1;
    spec.erase_attribute("chromaticities");
    return encode(dst, linear, {}, nthreads, error);
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
