// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_pictures.h"

#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "imagebuf/pixels/upright.h"
#include "sequence/report/bias_picture.h"
#include "sequence/report/bytes.h"
#include "sequence/report/encoded.h"
#include "sequence/report/reduced.h"
#include "sequence/results/json_text.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;
using OIIO::ImageBuf;
using OIIO::ROI;

constexpr int kLargeQuality = 82, kMapQuality = 85, kSmallQuality = 72;

struct Shown {
    ImageBuf reference, test; ///< 8 bits, sRGB-encoded
};

// Chooses both ends and evenly spaced exposures between them.
std::vector<double> chosen(const std::vector<double>& exposures) {
    const size_t n = exposures.size(), count = std::min(n, kMostExposures);
    std::vector<double> result;
    for (size_t i = 0; i < count; ++i)
        result.push_back(exposures[count == 1 ? 0 : (i * (n - 1) + (count - 1) / 2) / (count - 1)]);
    return result;
}

class Painter {
public:
    Painter(const PictureRequest& request, int nthreads)
        : m_request(request),
          m_nthreads(nthreads),
          m_look(request.look),
          m_whole(request.error  ? request.error->roi()
                  : request.bias ? request.bias->roi()
                                 : request.test->roi_full()),
          m_orientation(orientation_of(request.test->spec())) {
        m_look.pixels.layer.clear();
        if (!says_space_again(m_look.pixels))
            m_look.pixels.from.clear();
        m_look.alpha = AlphaPolicy::Ignore;
        m_look.size = SizePolicy::Match;
        m_look.memory = 0;
        m_whole.chbegin = 0;
        m_whole.chend = 1;
    }

    FramePictures draw() {
        FramePictures pictures;
        const PixelSize small = fitted(m_whole, kThumbnailSide);
        const Linear linear = read(m_whole, m_request.full ? fitted(m_whole, kPictureSide) : small);
        const std::vector<double> stops = exposures(linear);
        const double middle = (stops.front() + stops.back()) / 2;
        draw_small(pictures, linear, middle, small);
        if (m_request.full)
            draw_large(pictures, linear, stops);
        if (m_request.bias)
            draw_bias(pictures);
        draw_spots(pictures, middle);
        return pictures;
    }

private:
    struct Linear {
        ImageBuf reference, test; ///< three channels, as they are stored
    };

    Linear read(const ROI& region, const PixelSize& side) const {
        Linear linear;
        const auto part = [&](const ImageBuf& image) {
            return reduced_color(image, m_request.look.pixels, region_of(image, region), side);
        };
        linear.test = part(*m_request.test);
        if (m_request.reference)
            linear.reference = part(*m_request.reference);
        return linear;
    }

    // Where the test was resized for the comparison, the whole test corresponds to the whole
    // reference.
    ROI region_of(const ImageBuf& image, const ROI& region) const {
        return m_request.look.size == SizePolicy::Resize && &image == m_request.test
                   ? scaled(region, m_whole, image.roi_full())
                   : region;
    }

    std::vector<double> exposures(const Linear& linear) const {
        if (!m_request.hdr)
            return {0};
        if (!m_request.exposures.empty())
            return chosen(m_request.exposures);
        std::vector<FlipExposure> found;
        std::string error;
        const ROI one_pixel(0, 1, 0, 1);
        if (!ToneAlgo::flip_exposed(found, linear.test, linear.test, error, m_look, {}, one_pixel,
                                    m_nthreads))
            return {0};
        std::vector<double> stops;
        for (const FlipExposure& at : found)
            stops.push_back(at.stops);
        return chosen(stops);
    }

    // The pair as it is compared at one exposure: all of them together take much memory.
    Shown show(const Linear& linear, double stops) const {
        const ImageBuf& reference = m_request.reference ? linear.reference : linear.test;
        if (!m_request.hdr)
            return {displayed(reference), displayed(linear.test)};
        std::vector<FlipExposure> exposed;
        std::string error;
        if (!ToneAlgo::flip_exposed(exposed, reference, linear.test, error, m_look, {stops}, {},
                                    m_nthreads))
            throw std::runtime_error(error);
        return {srgb_bytes(exposed.at(0).reference), srgb_bytes(exposed.at(0).test)};
    }

    std::string uri(ImageBuf picture, Encoding encoding, int quality = kLargeQuality) const {
        return data_uri(upright(std::move(picture), m_orientation), encoding, quality);
    }

    ImageBuf displayed(const ImageBuf& linear) const {
        TonemapOptions options;
        options.curve.name = "linear";
        options.encode = "none";
        ImageBuf result;
        if (!ToneAlgo::tonemap(result, linear, options, nullptr, {}, m_nthreads))
            throw std::runtime_error(result.geterror());
        return srgb_bytes(result);
    }

    void draw_small(FramePictures& pictures, const Linear& linear, double stops,
                    const PixelSize& side) const {
        const Shown shown = show(linear, stops);
        pictures.small_test = uri(resized(shown.test, side), Encoding::Jpeg, kSmallQuality);
        if (m_request.error) {
            const ImageBuf error = reduced_maps(*m_request.error, nullptr, side).error;
            pictures.small_error =
                uri(colored_bytes(error, "magma"), Encoding::JpegMap, kSmallQuality);
        }
    }

    void draw_large(FramePictures& pictures, const Linear& linear,
                    const std::vector<double>& exposures) const {
        const PixelSize side = fitted(m_whole, kPictureSide);
        pictures.width = side.width;
        pictures.height = side.height;
        if (lies_on_its_side(m_orientation))
            std::swap(pictures.width, pictures.height);
        for (double stops : exposures) {
            const Shown shown = show(linear, stops);
            pictures.exposures.push_back(
                {stops, m_request.reference ? uri(shown.reference, Encoding::Jpeg) : "",
                 uri(shown.test, Encoding::Jpeg)});
        }
        if (m_request.error)
            draw_maps(pictures, side);
    }

    void draw_maps(FramePictures& pictures, const PixelSize& side) const {
        const ReducedMaps maps = reduced_maps(*m_request.error, m_request.stops, side);
        pictures.error = uri(colored_bytes(maps.error, "magma"), Encoding::JpegMap, kMapQuality);
        if (m_request.stops && !m_request.exposures.empty()) {
            pictures.first_stop = m_request.exposures.front();
            pictures.last_stop = m_request.exposures.back();
            pictures.stops =
                uri(colored_bytes(maps.stops, "viridis", pictures.first_stop, pictures.last_stop),
                    Encoding::Jpeg, kMapQuality);
        }
    }

    void draw_spots(FramePictures& pictures, double stops) const {
        for (const Position& at : m_request.spots) {
            const ROI near = OIIO::roi_intersection(ROI(at.x - kSpotRadius, at.x + kSpotRadius + 1,
                                                        at.y - kSpotRadius, at.y + kSpotRadius + 1,
                                                        m_whole.zbegin, m_whole.zend, 0, 1),
                                                    m_whole);
            const bool inside = near.width() > 0 && near.height() > 0;
            if (inside && pictures.spots.size() < kMostSpots)
                pictures.spots.push_back(spot(at, near, stops_at(at, stops)));
        }
    }

    void draw_bias(FramePictures& pictures) const {
        pictures.bias_range = bias_range(*m_request.bias, m_request.within);
        pictures.bias =
            uri(bias_picture(*m_request.bias, fitted(m_whole, kPictureSide), pictures.bias_range),
                Encoding::Png);
    }

    // The exposure of the largest error at this pixel.
    double stops_at(const Position& at, double otherwise) const {
        return m_request.stops ? double(m_request.stops->getchannel(at.x, at.y, 0, 0)) : otherwise;
    }

    SpotPictures spot(const Position& at, const ROI& near, double stops) const {
        const PixelSize side{near.width(), near.height()};
        const Linear linear = read(near, side);
        Shown shown = show(linear, stops);
        SpotPictures result;
        result.at = at;
        mark_nonfinite(shown.test, *m_request.test, m_request.look.pixels, near);
        result.test = uri(shown.test, Encoding::Png);
        if (m_request.reference) {
            mark_nonfinite(shown.reference, *m_request.reference, m_request.look.pixels, near);
            result.reference = uri(shown.reference, Encoding::Png);
        }
        if (m_request.error) {
            const ImageBuf error = OIIO::ImageBufAlgo::cut(*m_request.error, near);
            result.error = uri(colored_bytes(error, "magma"), Encoding::Png);
        }
        return result;
    }

    const PictureRequest& m_request;
    int m_nthreads;
    HdrFlipOptions m_look;
    ROI m_whole;
    int m_orientation; ///< orientation of both images
};

ordered_json json_of(const std::vector<SpotPictures>& spots) {
    ordered_json list = ordered_json::array();
    for (const SpotPictures& spot : spots) {
        list.push_back({{"x", spot.at.x},
                        {"y", spot.at.y},
                        {"reference", spot.reference},
                        {"test", spot.test},
                        {"error", spot.error}});
    }
    return list;
}

} // namespace

FramePictures draw_pictures(const PictureRequest& request, int nthreads) {
    return Painter(request, nthreads).draw();
}

std::string full_json(const FramePictures& pictures) {
    ordered_json to{{"width", pictures.width}, {"height", pictures.height}};
    to["exposures"] = ordered_json::array();
    for (const ExposurePictures& at : pictures.exposures) {
        to["exposures"].push_back(
            {{"stops", at.stops}, {"reference", at.reference}, {"test", at.test}});
    }
    to["error"] = pictures.error;
    to["stops"] = pictures.stops;
    to["range"] = {pictures.first_stop, pictures.last_stop};
    if (!pictures.bias.empty()) {
        to["bias"] = pictures.bias;
        to["bias_range"] = pictures.bias_range;
    }
    to["spots"] = json_of(pictures.spots);
    return one_line(to);
}

std::string small_json(const FramePictures& pictures) {
    return one_line({{"test", pictures.small_test},
                     {"error", pictures.small_error},
                     {"spots", json_of(pictures.spots)}});
}

std::string legend_uri(const std::string& map) {
    ImageBuf ramp(OIIO::ImageSpec(256, 1, 1, OIIO::TypeFloat));
    const float from[1] = {0.0f}, to[1] = {1.0f};
    OIIO::ImageBufAlgo::fill(ramp, from, to, from, to);
    return data_uri(colored_bytes(ramp, map), Encoding::Png);
}

std::string bias_legend_uri() {
    return data_uri(bias_ramp(), Encoding::Png);
}

} // namespace tonetool::sequence
