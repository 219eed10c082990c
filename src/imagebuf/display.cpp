// The public functions of include/tonetool/display.h.
#include "include/tonetool/display.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <exception>

#include "imagebuf/colorimetry.h"
#include "imagebuf/parallel.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
namespace IBA = OIIO::ImageBufAlgo;

bool fail(ImageBuf& dst, const char* function, const std::string& why) {
    dst.clear();
    dst.errorfmt("{}: {}", function, why);
    return false;
}

// Values within [0,1], NaN as 0.
ImageBuf unit_values(const ImageBuf& src, ROI roi, int nthreads) {
    const ImageBuf part = IBA::crop(src, roi, nthreads);
    ImageBuf fixed;
    IBA::fixNonFinite(fixed, part, IBA::NONFINITE_BLACK, nullptr, {}, nthreads);
    return IBA::clamp(fixed, 0.0f, 1.0f, false, {}, nthreads);
}

template <class Map>
bool mapped(ImageBuf& dst, const ImageBuf& src, int channel, ROI roi, int nthreads,
            const Map& map) {
    if (!src.initialized() || src.deep() || channel < -1 || channel >= src.nchannels() ||
        (channel == -1 && src.nchannels() < 3))
        return fail(dst, "color_map",
                    OIIO::Strutil::fmt::format("needs channel {} of a flat image; there are {}",
                                               channel, src.nchannels()));
    try {
        if (!roi.defined())
            roi = src.roi();
        ImageBuf linear;
        if (!map(linear, unit_values(src, roi, nthreads)))
            return fail(dst, "color_map", linear.geterror());
        linear.set_roi_full(src.roi_full());
        OIIO::ImageSpec& spec = linear.specmod();
        spec.channelnames = {"R", "G", "B"};
        spec.alpha_channel = spec.z_channel = -1;
        spec.erase_attribute("chromaticities");
        return ToneAlgo::encode_srgb(dst, linear, {}, nthreads);
    } catch (const std::exception& e) {
        return fail(dst, "color_map", e.what());
    }
}

} // namespace

namespace ToneAlgo {

bool color_map(ImageBuf& dst, const ImageBuf& src, const std::string& map, int channel, ROI roi,
               int nthreads) {
    const auto names = color_maps();
    if (std::find(names.begin(), names.end(), map) == names.end())
        return fail(dst, "color_map",
                    "unknown colour map \"" + map +
                        "\"; valid: " + OIIO::Strutil::join(names, ", "));
    return mapped(dst, src, channel, roi, nthreads, [&](ImageBuf& out, const ImageBuf& values) {
        return IBA::color_map(out, values, channel, map, {}, nthreads);
    });
}

bool color_map(ImageBuf& dst, const ImageBuf& src, const std::vector<float>& triples, int channel,
               ROI roi, int nthreads) {
    if (triples.size() < 6 || triples.size() % 3 != 0)
        return fail(dst, "color_map",
                    std::to_string(triples.size()) + " numbers: must be two or more RGB triples");
    return mapped(dst, src, channel, roi, nthreads, [&](ImageBuf& out, const ImageBuf& values) {
        return IBA::color_map(out, values, channel, int(triples.size() / 3), 3, triples, {},
                              nthreads);
    });
}

std::vector<std::string> color_maps() {
    return {"magma", "viridis", "inferno", "plasma", "turbo", "blue-red", "spectrum", "heat"};
}

bool encode_srgb(ImageBuf& dst, const ImageBuf& src, ROI roi, int nthreads) {
    ImageBuf out;
    if (!IBA::copy(out, src, OIIO::TypeFloat, roi, nthreads))
        return fail(dst, "encode_srgb", out.geterror());
    const int alpha = out.spec().alpha_channel, channels = out.nchannels();
    const int64_t row = int64_t(out.spec().width) * channels;
    auto* pixels = static_cast<float*>(out.localpixels());
    make_parallel(nthreads)(out.spec().height, [=](int64_t y) {
        for (int64_t i = 0; i < row; ++i)
            if (float& v = pixels[y * row + i]; i % channels != alpha)
                v = float(linear_to_srgb(std::clamp(double(v), 0.0, 1.0)));
    });
    out.specmod().attribute("oiio:ColorSpace", "sRGB");
    dst = std::move(out);
    return true;
}

} // namespace ToneAlgo
} // namespace tonetool
