// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/shown_pair.h"

#include <OpenImageIO/imagebufalgo.h>
#include <stdexcept>

#include "imagebuf/pixels/upright.h"
#include "sequence/report/bytes.h"

namespace tonetool::sequence {

using OIIO::ImageBuf;
using OIIO::ROI;

ShownPair::ShownPair(const PictureRequest& request, int nthreads)
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

ShownPair::Linear ShownPair::read(const ROI& region, const PixelSize& side) const {
    Linear linear;
    const auto part = [&](const ImageBuf& image) {
        return reduced_color(image, m_request.look.pixels, region_of(image, region), side);
    };
    linear.test = part(*m_request.test);
    if (m_request.reference)
        linear.reference = part(*m_request.reference);
    return linear;
}

ROI ShownPair::region_of(const ImageBuf& image, const ROI& region) const {
    return m_request.look.size == SizePolicy::Resize && &image == m_request.test
               ? scaled(region, m_whole, image.roi_full())
               : region;
}

double ShownPair::middle_exposure(const Linear& linear) const {
    if (!m_request.hdr)
        return 0;
    const std::vector<double>& compared = m_request.exposures;
    if (!compared.empty())
        return (compared.front() + compared.back()) / 2;
    std::vector<FlipExposure> found;
    std::string error;
    const ROI one_pixel(0, 1, 0, 1);
    const bool done = ToneAlgo::flip_exposed(found, linear.test, linear.test, error, m_look, {},
                                             one_pixel, m_nthreads);
    return done && !found.empty() ? (found.front().stops + found.back().stops) / 2 : 0;
}

double ShownPair::stops_at(const Position& at, double otherwise) const {
    return m_request.stops ? double(m_request.stops->getchannel(at.x, at.y, 0, 0)) : otherwise;
}

ShownPair::Shown ShownPair::show(const Linear& linear, double stops) const {
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

ShownPair::Shown ShownPair::show_region(const ROI& region, double stops) const {
    const Linear linear = read(region, {region.width(), region.height()});
    Shown shown = show(linear, stops);
    mark_nonfinite(shown.test, *m_request.test, m_request.look.pixels, region);
    if (m_request.reference)
        mark_nonfinite(shown.reference, *m_request.reference, m_request.look.pixels, region);
    return shown;
}

ImageBuf ShownPair::colored_error(const ROI& region) const {
    return colored_bytes(OIIO::ImageBufAlgo::cut(*m_request.error, region), "magma");
}

ImageBuf ShownPair::displayed(const ImageBuf& linear) const {
    TonemapOptions options;
    options.curve.name = "linear";
    options.encode = "none";
    ImageBuf result;
    if (!ToneAlgo::tonemap(result, linear, options, nullptr, {}, m_nthreads))
        throw std::runtime_error(result.geterror());
    return srgb_bytes(result);
}

} // namespace tonetool::sequence
