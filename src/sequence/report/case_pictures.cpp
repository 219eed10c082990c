// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/case_pictures.h"

#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "imagebuf/pixels/upright.h"
#include "sequence/report/bytes.h"
#include "sequence/report/shown_pair.h"
#include "sequence/results/automatic_limits.h"

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;

double largest_error(const ImageBuf& map) {
    std::vector<float> values(size_t(map.roi().npixels()) * size_t(map.nchannels()));
    double most = 0;
    if (map.get_pixels(map.roi(), OIIO::TypeFloat, values.data()))
        for (const float value : values)
            most = std::isfinite(value) ? std::max(most, double(value)) : most;
    return most;
}

CasePictures drawn_at(const PictureRequest& request, const ShownPair& pair, double stops) {
    const int orientation = pair.orientation();
    CasePictures pictures;
    ShownPair::Shown shown = pair.show_region(pair.whole(), stops);
    pictures.test = upright(std::move(shown.test), orientation);
    if (request.reference)
        pictures.reference = upright(std::move(shown.reference), orientation);
    pictures.bounded = request.error != nullptr;
    if (request.error)
        pictures.error = upright(pair.colored_error(pair.whole()), orientation);
    else if (request.unbounded)
        pictures.error = upright(
            colored_bytes(*request.unbounded, "magma", 0, largest_error(*request.unbounded)),
            orientation);
    if (request.hdr)
        pictures.stops = stops;
    if (orientation == 1) {
        pictures.x = pair.whole().xbegin;
        pictures.y = pair.whole().ybegin;
    }
    return pictures;
}

double middle_of(const ShownPair& pair) {
    return pair.middle_exposure(pair.read(pair.whole(), fitted(pair.whole(), kThumbnailSide)));
}

} // namespace

CasePictures draw_worst(const PictureRequest& request, const std::optional<Position>& worst,
                        int nthreads) {
    const ShownPair pair(request, nthreads);
    const bool found = worst && request.stops;
    return drawn_at(request, pair, found ? pair.stops_at(*worst, 0) : middle_of(pair));
}

CasePictures draw_case(const PictureRequest& request, const std::optional<double>& stops,
                       int nthreads) {
    const ShownPair pair(request, nthreads);
    return drawn_at(request, pair, stops ? *stops : middle_of(pair));
}

void CaseDrawing::take(const PictureRequest& request, const FrameResult& so_far, bool warned) {
    const bool pair = request.reference && request.compared;
    const bool measured = pair && !so_far.measurements.empty();
    const std::pair<bool, Status> rank{pair, measured ? so_far.measurements.back().status
                                                      : so_far.status};
    const bool may_be_bad =
        worst_always || warned || so_far.status > Status::Measured || has_automatic_limit(so_far);
    if (worst_asked && may_be_bad && (!worst.test.initialized() || m_rank < rank)) {
        worst = draw_worst(request,
                           measured ? so_far.measurements.back().worst : std::optional<Position>{});
        m_rank = rank;
    }
    if (first_asked && pair && !request.bias && !first.test.initialized())
        first = draw_case(request, stops);
}

} // namespace tonetool::sequence
