// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_pictures.h"

#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "imagebuf/pixels/upright.h"
#include "sequence/report/bias_picture.h"
#include "sequence/report/bytes.h"
#include "sequence/report/encoded.h"
#include "sequence/report/reduced.h"
#include "sequence/report/scene_pixels.h"
#include "sequence/report/shown_pair.h"

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

constexpr uint16_t kOne = 0x3c00; // as a half float
constexpr int kLogQuality = 88, kReducedQuality = 82, kMapQuality = 60, kStopsQuality = 40,
              kSmallQuality = 72;

class Painter {
public:
    Painter(const PictureRequest& request, int nthreads)
        : m_request(request),
          m_pair(request, nthreads),
          m_whole(m_pair.whole()) {}

    FramePictures draw() {
        FramePictures pictures;
        const PixelSize small = fitted(m_whole, kThumbnailSide);
        const ShownPair::Linear linear = m_pair.read(m_whole, small);
        const double middle = m_pair.middle_exposure(linear);
        draw_small(pictures, linear, middle, small);
        if (m_request.full)
            draw_large(pictures, middle);
        if (m_request.bias)
            draw_bias(pictures);
        draw_spots(pictures, middle);
        return pictures;
    }

private:
    std::string uri(ImageBuf picture, Encoding encoding, int quality = kMapQuality) const {
        return data_uri(upright(std::move(picture), m_pair.orientation()), encoding, quality);
    }

    void draw_small(FramePictures& pictures, const ShownPair::Linear& linear, double stops,
                    const PixelSize& side) const {
        const ShownPair::Shown shown = m_pair.show(linear, stops);
        pictures.small_test = uri(resized(shown.test, side), Encoding::Jpeg, kSmallQuality);
        if (m_request.error) {
            const ImageBuf error = reduced_maps(*m_request.error, nullptr, side).error;
            pictures.small_error =
                uri(colored_bytes(error, "magma"), Encoding::JpegMap, kSmallQuality);
        }
    }

    void draw_large(FramePictures& pictures, double middle) const {
        pictures.x = m_whole.xbegin;
        pictures.y = m_whole.ybegin;
        pictures.width = m_whole.width();
        pictures.height = m_whole.height();
        pictures.orientation = m_pair.orientation();
        pictures.space = space_name();
        const bool worst = m_request.stops && !m_request.spots.empty();
        pictures.start = worst ? m_pair.stops_at(m_request.spots.front(), middle) : middle;
        if (m_request.error)
            draw_maps(pictures, fitted(m_whole, kPictureSide));
        draw_side(*m_request.test, pictures, &PairTexts::test, &NumberPictures::test);
        if (m_request.reference) {
            draw_side(*m_request.reference, pictures, &PairTexts::reference,
                      &NumberPictures::reference);
        }
        if (m_request.large && pictures.near && m_request.error)
            pictures.near->error = error_numbers(*pictures.near);
    }

    std::string space_name() const {
        ColorChoice choice;
        std::string ignored;
        (void)ToneAlgo::find_color(m_request.test->spec(), m_request.look.pixels, choice, ignored);
        return choice.space;
    }

    void draw_side(const ImageBuf& image, FramePictures& pictures, std::string PairTexts::*side,
                   NumberTexts NumberPictures::*numbers) const {
        const PixelOptions& options = m_request.look.pixels;
        const ROI region = m_pair.region_of(image, m_whole);
        const PixelSize side_reduced = fitted(m_whole, kPictureSide);
        const bool resized =
            region.width() != m_whole.width() || region.height() != m_whole.height();
        const PixelSize whole{m_whole.width(), m_whole.height()};
        ScenePixels pixels = resized ? scene_means(image, options, region, whole)
                                     : scene_pixels(image, options, region);
        if (m_request.large)
            pictures.large.*side = uri(log_codes(pixels), Encoding::Jpeg, kLogQuality);
        const ScenePixels means = reduced(pixels, side_reduced);
        pictures.pictures.*side = uri(log_codes(means), Encoding::Jpeg, kReducedQuality);
        if (std::any_of(pixels.alpha.begin(), pixels.alpha.end(),
                        [](uint16_t half) { return half != kOne; }))
            pictures.alpha.*side = alpha_uri(pixels);
        draw_near(pixels, pictures, numbers);
        if (m_request.exact == PictureRequest::Exact::All)
            draw_exact(std::move(pixels), pictures, numbers);
        else if (m_request.exact == PictureRequest::Exact::Means)
            draw_exact(means, pictures, numbers);
    }

    Position centre_of_interest() const {
        const Position centre{(m_whole.xbegin + m_whole.xend) / 2,
                              (m_whole.ybegin + m_whole.yend) / 2};
        return m_request.spots.empty() ? centre : m_request.spots.front();
    }

    void draw_near(const ScenePixels& pixels, FramePictures& pictures,
                   NumberTexts NumberPictures::*numbers) const {
        const Position at = centre_of_interest();
        const auto along = [](int place, int size) {
            const int side = std::min(kNearSide, size);
            return std::clamp(place - side / 2, 0, size - side);
        };
        const int x = along(at.x - m_whole.xbegin, pixels.width),
                  y = along(at.y - m_whole.ybegin, pixels.height);
        const ROI part(x, std::min(x + kNearSide, pixels.width), y,
                       std::min(y + kNearSide, pixels.height));
        if (!pictures.near) {
            pictures.near = NumberPictures{m_whole.xbegin + x,
                                           m_whole.ybegin + y,
                                           part.width(),
                                           part.height(),
                                           part.width(),
                                           part.height(),
                                           {},
                                           {},
                                           ""};
        }
        (*pictures.near).*numbers = number_texts(part_of(pixels, part));
    }

    void draw_exact(ScenePixels pixels, FramePictures& pictures,
                    NumberTexts NumberPictures::*numbers) const {
        if (!pictures.exact) {
            pictures.exact = NumberPictures{m_whole.xbegin,
                                            m_whole.ybegin,
                                            m_whole.width(),
                                            m_whole.height(),
                                            pixels.width,
                                            pixels.height,
                                            {},
                                            {},
                                            ""};
        }
        (*pictures.exact).*numbers = number_texts(std::move(pixels));
    }

    NumberTexts number_texts(ScenePixels pixels) const {
        shorten(pixels.color);
        NumberTexts texts;
        texts.high = uri(high_bytes(pixels), Encoding::PngBytes);
        texts.low = uri(low_bytes(pixels), Encoding::PngBytes);
        const auto& alpha = pixels.alpha;
        if (alpha.empty())
            return texts;
        if (std::all_of(alpha.begin(), alpha.end(),
                        [&](uint16_t one) { return one == alpha[0]; }) &&
            std::isfinite(half_value(alpha[0])))
            texts.one_alpha = half_value(alpha[0]);
        else
            texts.alpha = uri(both_bytes(alpha, pixels.width, pixels.height), Encoding::PngBytes);
        return texts;
    }

    std::string error_numbers(const NumberPictures& near) const {
        const ROI part(near.x, near.x + near.width, near.y, near.y + near.height,
                       m_request.error->zbegin(), m_request.error->zend(), 0, 1);
        std::vector<uint16_t> halves(size_t(part.width()) * size_t(part.height()));
        if (!m_request.error->get_pixels(part, OIIO::TypeDesc::HALF, halves.data()))
            return "";
        shorten(halves);
        return uri(both_bytes(halves, part.width(), part.height()), Encoding::PngBytes);
    }

    std::string alpha_uri(const ScenePixels& pixels) const {
        std::vector<float> values;
        values.reserve(pixels.alpha.size());
        for (const uint16_t half : pixels.alpha)
            values.push_back(half_value(half));
        ImageBuf image(OIIO::ImageSpec(pixels.width, pixels.height, 1, OIIO::TypeFloat));
        image.set_pixels(image.roi(), OIIO::TypeFloat, values.data());
        return uri(coded_bytes(sequence::resized(image, fitted(m_whole, kPictureSide))),
                   Encoding::Jpeg);
    }

    void draw_maps(FramePictures& pictures, const PixelSize& side) const {
        const ReducedMaps maps = reduced_maps(*m_request.error, m_request.stops, side);
        pictures.error = uri(coded_bytes(maps.error), Encoding::Jpeg);
        if (m_request.stops && !m_request.exposures.empty()) {
            pictures.first_stop = m_request.exposures.front();
            pictures.last_stop = m_request.exposures.back();
            pictures.stops = uri(coded_bytes(maps.stops, pictures.first_stop, pictures.last_stop),
                                 Encoding::Jpeg, kStopsQuality);
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
                pictures.spots.push_back(spot(at, near, m_pair.stops_at(at, stops)));
        }
    }

    void draw_bias(FramePictures& pictures) const {
        pictures.bias_range = bias_range(*m_request.bias, m_request.within);
        pictures.bias =
            uri(bias_picture(*m_request.bias, fitted(m_whole, kPictureSide), pictures.bias_range),
                Encoding::Png);
    }

    SpotPictures spot(const Position& at, const ROI& near, double stops) const {
        const ShownPair::Shown shown = m_pair.show_region(near, stops);
        SpotPictures result;
        result.at = at;
        result.test = uri(shown.test, Encoding::Png);
        if (m_request.reference)
            result.reference = uri(shown.reference, Encoding::Png);
        if (m_request.error)
            result.error = uri(m_pair.colored_error(near), Encoding::Png);
        return result;
    }

    const PictureRequest& m_request;
    ShownPair m_pair;
    ROI m_whole;
};

} // namespace

FramePictures draw_pictures(const PictureRequest& request, int nthreads) {
    return Painter(request, nthreads).draw();
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
