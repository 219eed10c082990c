#include "sequence/reduced.h"

#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
namespace IBA = OIIO::ImageBufAlgo;

ColorChoice color_of(const ImageBuf& image, const PixelOptions& options) {
    ColorChoice choice;
    std::string error;
    if (!ToneAlgo::find_color(image.spec(), options, choice, error)) {
        throw std::runtime_error(error);
    }
    return choice;
}

void check(const ImageBuf& image, bool done) {
    if (!done || image.has_error()) {
        throw std::runtime_error(image.geterror());
    }
}

// Says the space as find_color() reads it of floats: Rec.709 by saying nothing.
void tag(OIIO::ImageSpec& spec, const std::string& space) {
    spec.erase_attribute("oiio:ColorSpace");
    if (space != "chromaticities") {
        spec.erase_attribute("chromaticities");
        if (space != "rec709") {
            spec.attribute("oiio:ColorSpace", space);
        }
    }
}

// The colour of a region, at the origin and as floats, with its own colour space in the header.
ImageBuf color_cut(const ImageBuf& image, const PixelOptions& options, ROI region) {
    const ColorChoice choice = color_of(image, options);
    const int order[3] = {choice.r, choice.g, choice.b};
    const std::string names[3] = {"R", "G", "B"};
    region.chbegin = 0;
    region.chend = image.nchannels();
    ImageBuf part, result;
    check(part, IBA::cut(part, image, region));
    check(result, IBA::channels(result, part, 3, order, {}, names));
    ImageBuf floats = result.copy(OIIO::TypeFloat);
    tag(floats.specmod(), choice.space);
    return floats;
}

} // namespace

Side fitted(const ROI& region, int longest) {
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

ImageBuf resized(const ImageBuf& image, const Side& side, int nthreads) {
    if (image.spec().width == side.width && image.spec().height == side.height) {
        return image;
    }
    ImageBuf result;
    const ROI target(0, side.width, 0, side.height, 0, 1, 0, image.nchannels());
    check(result, IBA::resize(result, image, "box", 0.0f, target, nthreads));
    return result;
}

ImageBuf reduced_color(const ImageBuf& image, const PixelOptions& options, const ROI& region,
                       const Side& side, int nthreads) {
    ImageBuf color = color_cut(image, options, region);
    check(color, IBA::fixNonFinite(color, color, IBA::NONFINITE_BLACK, nullptr, {}, nthreads));
    return resized(color, side, nthreads);
}

ReducedMaps reduced_maps(const ImageBuf& error, const ImageBuf* stops, const Side& side) {
    const ROI all = error.roi();
    const OIIO::ImageSpec spec(side.width, side.height, 1, OIIO::TypeFloat);
    ReducedMaps maps{ImageBuf(spec), ImageBuf(spec)};
    check(maps.error, IBA::fill(maps.error, -1.0f));
    ImageBuf::Iterator<float> most(maps.error);
    ImageBuf::Iterator<float> at(maps.stops);
    for (ImageBuf::ConstIterator<float> pixel(error); !pixel.done(); ++pixel) {
        const int x = int(int64_t(pixel.x() - all.xbegin) * side.width / all.width());
        const int y = int(int64_t(pixel.y() - all.ybegin) * side.height / all.height());
        most.pos(x, y);
        if (pixel[0] > most[0]) {
            most[0] = pixel[0];
            if (stops) {
                at.pos(x, y);
                at[0] = stops->getchannel(pixel.x(), pixel.y(), 0, 0);
            }
        }
    }
    return maps;
}

void mark_nonfinite(ImageBuf& shown, const ImageBuf& image, const PixelOptions& options,
                    const ROI& region) {
    const ColorChoice choice = color_of(image, options);
    const float magenta[3] = {1, 0, 1};
    for (ImageBuf::ConstIterator<float> pixel(image, region); !pixel.done(); ++pixel) {
        const bool finite = std::isfinite(pixel[choice.r]) && std::isfinite(pixel[choice.g]) &&
                            std::isfinite(pixel[choice.b]);
        if (!finite) {
            shown.setpixel(pixel.x() - region.xbegin, pixel.y() - region.ybegin, magenta);
        }
    }
}

} // namespace tonetool::sequence
