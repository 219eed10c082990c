#include "chain/frame_pictures.h"

#include <algorithm>

#include "chain/first_part.h"
#include "sequence/report_store.h"

namespace tonetool::chain {

namespace {

// A quarter of a frame's memory for each image; the rest is the comparison's.
bool fits(const Session& session, const Image& image) {
    const uint64_t bytes = image.part().header().image_pixels() * 4 * sizeof(float);
    return session.memory == 0 || bytes * 4 <= session.memory;
}

bool is_read(const OIIO::ImageBuf* image) {
    return !image || image->storage() != OIIO::ImageBuf::IMAGECACHE;
}

} // namespace

OIIO::ImageBuf shown_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options) {
    if (!fits(session, image)) {
        return color_source(session, call, image, options);
    }
    check_color(session, call, image, options);
    Part& part = image.part();
    ColorChoice choice;
    std::string why;
    if (!ToneAlgo::find_color(part.header(), options, choice, why)) {
        return part.color_view();
    }
    const int alpha = choice.a < 0 ? choice.r : choice.a;
    return part.color_view(std::min({choice.r, choice.g, choice.b, alpha}),
                           std::max({choice.r, choice.g, choice.b, alpha}) + 1);
}

void show(Session& session, const Call& call, sequence::PictureRequest request) {
    if (!session.painter || session.painter->drawn) {
        return;
    }
    const std::string nothing = call.row().label() + ": no pictures for the report: ";
    if (!is_read(request.reference) || !is_read(request.test)) {
        session.report(nothing + "the images do not fit into --memory");
        return;
    }
    sequence::FrameResult so_far = *session.result;
    sequence::judge(so_far);
    request.full = session.painter->store.wants_full(so_far);
    for (const sequence::Measurement& measured : so_far.measurements) {
        if (measured.worst) {
            request.spots.push_back(*measured.worst);
        }
    }
    try {
        session.painter->drawn = sequence::draw_pictures(request);
    } catch (const std::exception& problem) {
        session.report(nothing + problem.what());
    }
}

} // namespace tonetool::chain
