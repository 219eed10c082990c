// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/reduced.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "imagebuf/pixels/float_rows.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "sequence/report/pixel_rows.h"

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

ColorChoice color_of(const ImageBuf& image, const PixelOptions& options) {
    ColorChoice choice;
    std::string error;
    if (!ToneAlgo::find_color(image.spec(), options, choice, error))
        throw std::runtime_error(error);
    return choice;
}

// A header from which find_color() reads the space of floats: no tag means Rec.709; a space that
// only a configuration knows has no tag, either.
OIIO::ImageSpec tagged(const OIIO::ImageSpec& from, const std::string& space,
                       const PixelOptions& options) {
    OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeFloat);
    if (const OIIO::ParamValue* exposure = from.find_attribute("hdr:exposure"))
        spec.extra_attribs.push_back(*exposure);
    if (says_space_again(options))
        return spec;
    if (space == "chromaticities") {
        float values[8] = {};
        from.getattribute("chromaticities", OIIO::TypeDesc("float[8]"), values);
        spec.attribute("chromaticities", OIIO::TypeDesc("float[8]"), values);
    } else if (space != "rec709") {
        spec.attribute("oiio:ColorSpace", space);
    }
    return spec;
}

// The pixel of a reduced side that a pixel of the region falls on.
int target(int at, int from, int to) {
    return int(int64_t(at) * to / from);
}

// Sums of the finite pixels that fall on each pixel of a reduced row.
struct RowSums {
    std::vector<double> color;
    std::vector<int> count;

    explicit RowSums(int width) : color(size_t(width) * 3), count(size_t(width)) {}

    void add(size_t at, const float* pixel) {
        if (std::isfinite(pixel[0]) && std::isfinite(pixel[1]) && std::isfinite(pixel[2])) {
            ++count[at];
            for (size_t c = 0; c < 3; ++c)
                color[3 * at + c] += double(pixel[c]);
        }
    }

    void write(ImageBuf& image, int y) const {
        for (size_t x = 0; x < count.size(); ++x) {
            const double scale = count[x] > 0 ? 1.0 / count[x] : 0;
            const float mean[3] = {float(color[3 * x] * scale), float(color[3 * x + 1] * scale),
                                   float(color[3 * x + 2] * scale)};
            image.setpixel(int(x), y, mean);
        }
    }
};

} // namespace

bool says_space_again(const PixelOptions& options) {
    return !options.config.empty() && !options.from.empty();
}

std::vector<size_t> targets(int from, int to) {
    std::vector<size_t> all(static_cast<size_t>(from));
    for (int x = 0; x < from; ++x)
        all[size_t(x)] = size_t(target(x, from, to));
    return all;
}

PixelSize fitted(const ROI& region, int longest) {
    const double scale = std::min(1.0, double(longest) / std::max(region.width(), region.height()));
    return {std::max(1, int(std::lround(region.width() * scale))),
            std::max(1, int(std::lround(region.height() * scale)))};
}

ROI scaled(const ROI& part, const ROI& from, const ROI& to) {
    const auto along = [](int at, int a0, int a1, int b0, int b1) {
        return b0 + int(std::lround(double(at - a0) * (b1 - b0) / (a1 - a0)));
    };
    ROI result = to;
    result.xbegin = along(part.xbegin, from.xbegin, from.xend, to.xbegin, to.xend);
    result.xend = along(part.xend, from.xbegin, from.xend, to.xbegin, to.xend);
    result.ybegin = along(part.ybegin, from.ybegin, from.yend, to.ybegin, to.yend);
    result.yend = along(part.yend, from.ybegin, from.yend, to.ybegin, to.yend);
    result.xend = std::max(result.xend, result.xbegin + 1);
    result.yend = std::max(result.yend, result.ybegin + 1);
    return result;
}

ImageBuf resized(const ImageBuf& image, const PixelSize& side) {
    if (image.spec().width == side.width && image.spec().height == side.height)
        return image;
    ImageBuf result;
    const ROI to(0, side.width, 0, side.height, 0, 1, 0, image.nchannels());
    if (!oiio::resize(result, image, "box", to))
        throw std::runtime_error(result.geterror());
    return result;
}

ImageBuf reduced_color(const ImageBuf& image, const PixelOptions& options, const ROI& region,
                       const PixelSize& wanted) {
    // An image that is smaller than this (it was compared resized) is enlarged in the last step.
    const PixelSize side{std::min(wanted.width, region.width()),
                         std::min(wanted.height, region.height())};
    const ColorChoice choice = color_of(image, options);
    OIIO::ImageSpec spec = tagged(image.spec(), choice.space, options);
    spec.width = spec.full_width = side.width;
    spec.height = spec.full_height = side.height;
    ImageBuf result(spec);
    PixelRows rows(image, region, {choice.r, choice.g, choice.b});
    const std::vector<size_t> columns = targets(region.width(), side.width);
    int y = 0;
    for (int to = 0; to < side.height; ++to) {
        RowSums sums(side.width);
        for (; y < region.height() && target(y, region.height(), side.height) == to; ++y) {
            const std::vector<float>& row = rows.read(region.ybegin + y);
            for (size_t x = 0; x < columns.size(); ++x)
                sums.add(columns[x], row.data() + 3 * x);
        }
        sums.write(result, to);
    }
    return resized(result, wanted);
}

ReducedMaps reduced_maps(const ImageBuf& error, const ImageBuf* stops, const PixelSize& side) {
    const ROI all = error.roi();
    const size_t width = size_t(side.width);
    std::vector<float> most(width * size_t(side.height), -1.0f), at(most.size());
    const std::vector<size_t> columns = targets(all.width(), side.width);
    PixelRows errors(error, all, {0}), exposures(stops ? *stops : error, all, {0});
    for (int y = 0; y < all.height(); ++y) {
        const std::vector<float>& row = errors.read(all.ybegin + y);
        const std::vector<float>& of = exposures.read(all.ybegin + y);
        const size_t line = size_t(target(y, all.height(), side.height)) * width;
        for (size_t x = 0; x < columns.size(); ++x) {
            const size_t i = line + columns[x];
            if (row[x] > most[i]) {
                most[i] = row[x];
                at[i] = of[x];
            }
        }
    }
    const OIIO::ImageSpec spec(side.width, side.height, 1, OIIO::TypeFloat);
    ReducedMaps maps{ImageBuf(spec), ImageBuf(spec)};
    maps.error.set_pixels(maps.error.roi(), OIIO::TypeFloat, most.data());
    maps.stops.set_pixels(maps.stops.roi(), OIIO::TypeFloat, at.data());
    return maps;
}

void mark_nonfinite(ImageBuf& shown, const ImageBuf& image, const PixelOptions& options,
                    const ROI& region) {
    const ColorChoice choice = color_of(image, options);
    const float magenta[3] = {1, 0, 1};
    ROI all = region;
    all.chbegin = 0;
    all.chend = image.nchannels();
    for_each_row(image, all, [&](int y, const float* pixel) {
        for (int x = 0; x < region.width(); ++x, pixel += all.nchannels()) {
            const bool finite = std::isfinite(pixel[choice.r]) && std::isfinite(pixel[choice.g]) &&
                                std::isfinite(pixel[choice.b]);
            if (!finite)
                shown.setpixel(x, y - region.ybegin, magenta);
        }
    });
}

} // namespace tonetool::sequence
