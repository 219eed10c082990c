// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/planes.h"

#include <algorithm>

#include "imagebuf/pixels/colorimetry.h"
#include "imagebuf/pixels/has_pixels.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "metrics/refusal.h"

namespace tonetool {

using OIIO::ImageBuf;

void ColorCounts::add(const ColorCounts& other) {
    nonfinite += other.nonfinite;
    negative += other.negative;
    largest = std::max(largest, other.largest);
    negative_digest += other.negative_digest;
    alpha_digest += other.alpha_digest;
}

kernels::ConstRgb ColorPlanes::view() const {
    return {{plane[0].data(), plane[1].data(), plane[2].data()},
            width(),
            width(),
            region.height(),
            begin - region.ybegin};
}

void ColorPlanes::row(int x, int y, const float* (&out)[3]) const {
    for (size_t p = 0; p < 3; ++p)
        out[p] = plane[p].data() + at(y) + size_t(x - region.xbegin);
}

namespace {

// Whether the edges of a window are so far apart as it says.
bool within_integers(const OIIO::ROI& window) {
    return int64_t(window.xend) - window.xbegin <= INT32_MAX &&
           int64_t(window.yend) - window.ybegin <= INT32_MAX && window.xend > window.xbegin &&
           window.yend > window.ybegin;
}

} // namespace

std::string side_name(const char* side, const ImageBuf& image) {
    const std::string name(image.name());
    return std::string(side) + " image" + (name.empty() ? ": " : " \"" + name + "\": ");
}

std::string with_side(const std::string& side_name, const std::string& why) {
    const std::string name = side_name.substr(std::min(side_name.find('"'), side_name.size()));
    const bool twice = !name.empty() && why.compare(0, name.size(), name) == 0;
    return side_name + (twice ? why.substr(name.size()) : why);
}

void check_readable(const ImageBuf& image, const char* what) {
    const auto fail = [&](const std::string& why) { throw Refusal(side_name(what, image) + why); };
    if (!image.initialized() && !image.has_error() && image.name().empty())
        fail("is not initialized");
    if (image.spec().nchannels == 0 || image.has_error()) {
        const std::string why = image.geterror();
        fail(why.empty() ? "could not be read" : why);
    }
    if (image.deep())
        fail("deep images are not supported; flatten it first");
    if (image.spec().depth > 1)
        fail("volumes are not supported");
    if (image.roi().width() <= 0 || image.roi().height() <= 0)
        fail("has no pixels");
    if (!within_integers(image.roi()) || !within_integers(image.roi_full()))
        fail("its data window or display window reaches beyond what 32-bit coordinates tell");
    // A read that failed, whose error somebody has taken.
    if (!has_pixels(image)) {
        const std::string why = image.geterror();
        fail(why.empty() ? "could not be read" : why);
    }
}

std::vector<int> channels_of(const ColorChoice& choice) {
    if (choice.grey())
        return {choice.r};
    return {choice.r, choice.g, choice.b};
}

OIIO::ImageSpec deciding_spec(const ImageBuf& image) {
    OIIO::ImageSpec spec = image.spec();
    const OIIO::ImageSpec& native = image.nativespec();
    take_whole_exposure(spec, std::string(image.name()));
    if (const std::string stored = spec.get_string_attribute(kStoredType); !stored.empty())
        spec.format = OIIO::TypeDesc(stored);
    if (native.nchannels != spec.nchannels)
        return spec;
    if (oiio::encodes_with_alpha(native, std::string(image.file_format_name())))
        spec.format = OIIO::TypeFloat; // with the tag that the file has
    else if (!native.format.is_floating_point())
        spec.format = native.format;
    spec.channelformats = native.channelformats;
    return spec;
}

} // namespace tonetool
