// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/frame_pictures.h"

#include <algorithm>

#include "chain/commands/color_input.h"
#include "sequence/report/report_store.h"
#include "sequence/results/results.h"

namespace tonetool::chain {

namespace {

bool is_read(const OIIO::ImageBuf* image) {
    return !image || image->storage() != OIIO::ImageBuf::IMAGECACHE;
}

// How much is drawn of the frame if it is among the worst so far.
void ask_for_worst(sequence::PictureRequest& request, const sequence::FramePainter& painter,
                   const sequence::FrameResult& so_far) {
    using sequence::PictureSize;
    using Exact = sequence::PictureRequest::Exact;
    const sequence::PictureStore& store = painter.store;
    request.full = store.wants(PictureSize::Full, so_far) && painter.wants_full(request);
    request.large = request.full && store.wants(PictureSize::Large, so_far);
    const bool exact = request.full && store.wants(PictureSize::Exact, so_far);
    request.exact = !exact ? Exact::No : store.counts().exact == 0 ? Exact::Means : Exact::All;
}

} // namespace

uint64_t shown_bytes(const Session& session, const Call& call) {
    uint64_t bytes = 0;
    for (const ImagePtr& image : call.images)
        bytes += image->part().header().image_pixels() * 4 * sizeof(float);
    const bool fits = session.settings.memory == 0 || bytes <= session.settings.memory / 3;
    return session.check.painter && fits ? bytes : 0;
}

OIIO::ImageBuf shown_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options) {
    if (shown_bytes(session, call) == 0)
        return color_source(session, call, image, options);
    Part& part = checked_part(session, call, image, options);
    ColorChoice choice;
    std::string why;
    if (!ToneAlgo::find_color(part.header(), options, choice, why))
        return part.color_view();
    const int alpha = choice.a < 0 ? choice.r : choice.a;
    return part.color_view(std::min({choice.r, choice.g, choice.b, alpha}),
                           std::max({choice.r, choice.g, choice.b, alpha}) + 1);
}

void show(Session& session, const Call& call, sequence::PictureRequest request) {
    if (!session.check.painter)
        return;
    sequence::FramePainter& painter = *session.check.painter;
    const std::string nothing = call.row().label() + ": no pictures for the report: ";
    if (!is_read(request.reference) || !is_read(request.test)) {
        session.report(nothing + "the images do not fit into --memory");
        return;
    }
    static_cast<IgnoreOptions&>(request.look) = {}; // the images are shown as they are
    sequence::FrameResult so_far = *session.check.result;
    sequence::judge(so_far);
    try {
        if (painter.beside)
            painter.beside->take(request, so_far, session.outcome.warnings > 0);
    } catch (const std::exception& problem) {
        session.report(call.row().label() + ": no images: " + problem.what());
    }
    if (!painter.for_report)
        return;
    ask_for_worst(request, painter, so_far);
    for (const sequence::Measurement& measured : so_far.measurements)
        if (measured.worst && request.full)
            request.spots.push_back(*measured.worst);
    try {
        painter.take(sequence::draw_pictures(request), request);
    } catch (const std::exception& problem) {
        session.report(nothing + problem.what());
    }
}

} // namespace tonetool::chain
