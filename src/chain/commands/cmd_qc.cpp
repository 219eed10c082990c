// SPDX-License-Identifier: BSD-3-Clause
// --qc: the faults of an image that are found without a reference.
#include <algorithm>

#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/fault_args.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/frame_pictures.h"
#include "sequence/qc/qc.h"
#include "sequence/qc/qc_json.h"
#include "sequence/results/results.h"
#include "text/error.h"
#include "tonetool/qc.h"

namespace tonetool::chain {

namespace {

bool has_picture(const QcFacts& facts) {
    return std::any_of(facts.layers.begin(), facts.layers.end(),
                       [](const QcLayer& layer) { return layer.kind == "picture"; });
}

// Draws the image, and enlarged the pixels that have a fault or may turn out to have one.
void show_faults(Session& session, const Call& call, const sequence::QcRecord& record) {
    if (!session.check.painter || !has_picture(record.facts))
        return;
    const sequence::FrameResult before = *session.check.result;
    session.check.result->faults = sequence::picture_faults(record);
    sequence::PictureRequest request;
    for (const sequence::Fault& fault : session.check.result->faults)
        if (fault.position)
            request.spots.push_back(*fault.position);
    for (const QcSpot& spike : record.facts.picture.spikes)
        request.spots.push_back({spike.x, spike.y});
    request.look.pixels = pixel_options(call);
    const OIIO::ImageBuf picture = shown_input(session, call, *call.images[0], request.look.pixels);
    request.test = &picture;
    show(session, call, std::move(request));
    *session.check.result = before;
}

void run_qc(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    if (image.is_result) {
        throw CommandError("\"" + image.name() +
                           "\" is what a comparison has made, no render (valid: "
                           "--qc before the comparison)");
    }
    sequence::QcRecord record;
    record.limits = fault_limits(call, sequence::qc_rules());
    session.stack.push(call.images[0]);
    session.outcome.produced = true;
    if (!session.check.result)
        return; // this run only measures the exposures of the shot
    std::vector<OIIO::ImageBuf> parts;
    std::vector<const OIIO::ImageBuf*> pointers;
    for (const PartPtr& part : image.parts())
        parts.push_back(part->color_source());
    for (const OIIO::ImageBuf& part : parts)
        pointers.push_back(&part);
    QcOptions options{pixel_options(call), {}};
    if (const auto groups = call.text("groups"))
        options.groups = split(*groups, ',');
    std::string why;
    if (!ToneAlgo::qc_facts(record.facts, pointers, why, options))
        throw CommandError("\"" + image.name() + "\": " + why);
    take_types(image, record.facts.channels);
    if (has_picture(record.facts) && !session.check.painter) // which reads the image itself
        tell_encoding(session, call, image, image.part().header(), options.pixels);
    if (session.frame.loops && (!session.frame.item().named() || session.frame.number != 0))
        record.strays = sequence::stray_files(image.name(), session.frame.number);
    session.check.result->qc = sequence::to_json(record);
    show_faults(session, call, record);
}

} // namespace

Rows qc_commands() {
    return {command("qc",
                    "Look for faults that need no reference; severities: off, info, warning, error",
                    run_qc)
                .checked([](Session&, const Call& call) {
                    (void)fault_limits(call, sequence::qc_rules());
                })
                .images(1, 1)
                .modifiers(pixel_modifiers())
                .modifier("groups", "NAME,...", "light groups that must add up to the beauty (all)")
                .modifiers(fault_modifiers(sequence::qc_rules()))};
}

} // namespace tonetool::chain
