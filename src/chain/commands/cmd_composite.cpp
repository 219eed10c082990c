// SPDX-License-Identifier: BSD-3-Clause
// Compositing, pasting, contact sheets and deep images.
#include <algorithm>
#include <cstdio>

#include "chain/commands/commands.h"
#include "chain/images/sheet.h"
#include "chain/session/ops.h"

namespace tonetool::chain {

namespace {

struct Position {
    int x = 0, y = 0;
};

// The offset that the images' own windows give.
Position asked_position(const Session& session, const std::string& text) {
    Position position;
    int end = 0;
    if (text != "-" && text != "auto" &&
        (std::sscanf(text.c_str(), "%d%d%n", &position.x, &position.y, &end) != 2 ||
         (!session.settings.compat && size_t(end) < text.size()))) {
        throw CommandError("Invalid offset '" + text + "'" +
                           (session.settings.compat ? "" : " (valid: +X+Y, auto, -)"));
    }
    return position;
}

std::vector<const OIIO::ImageBuf*> flat_pixels_of(const std::vector<ImagePtr>& images) {
    std::vector<const OIIO::ImageBuf*> all;
    for (const ImagePtr& image : images) {
        if (image->part().header().deep) {
            throw CommandError("\"" + image->name() +
                               "\" is deep, which this command cannot use (--flatten makes it "
                               "flat)");
        }
        all.push_back(&image->part().pixels());
    }
    return all;
}

void run_paste(Session& session, const Call& call) {
    std::vector<ImagePtr> images = take_images(session, call.flag("all", false) ? 0 : 2);
    const Position at = asked_position(session, call.argument(0));
    OIIO::ImageBuf result =
        pasted(flat_pixels_of(images), at.x, at.y, call.flag("mergeroi", false));
    session.stack.push(Image::derived(*images.back(), std::move(result)));
}

bool paste_metadata(Op& op) {
    bool done = op.dst.copy(op.b());
    op.dst.specmod().extra_attribs = op.a().spec().extra_attribs;
    op.dst.set_roi_full(op.a().roi_full());
    return done;
}

void run_mosaic(Session& session, const Call& call) {
    auto size = parsed_size(call.argument(0));
    if (!size || size->width < 1 || size->height < 1) {
        throw CommandError("Invalid size '" + call.argument(0) + "'" +
                           (session.settings.compat ? "" : " (valid: COLUMNSxROWS)"));
    }
    const auto fit = call.text("fit");
    Sheet sheet{int(size->width), int(size->height)};
    sheet.pad = call.integer("pad", kAnyInteger).value_or(0);
    sheet.fit = fit ? parsed_size(*fit) : std::nullopt;
    if (fit && !sheet.fit && !session.settings.compat)
        throw CommandError("fit \"" + *fit + "\" is no size (valid: WxH)");
    const size_t cells = size_t(sheet.columns) * size_t(sheet.rows);
    std::vector<ImagePtr> images =
        take_images(session, std::min(cells, session.stack.images.size()));
    session.stack.push(Image::created("mosaic", mosaic(sheet, flat_pixels_of(images))));
}

const Rows kCompositeRows = {
    on_pixels("over", 2, "The first image over the second",
              [](Op& op) { return IBA::over(op.dst, op.a(), op.b()); }),
    on_pixels("zover", 2, "The nearer of two images with Z channels over the other",
              [](Op& op) { return IBA::zover(op.dst, op.a(), op.b(), op.flag("zeroisinf")); })
        .modifier("zeroisinf", "0|1", "Z of 0 is infinitely far"),
    on_pixels("deepmerge", 2, "Merge two deep images",
              [](Op& op) {
                  op.dst = IBA::deep_merge(op.a(), op.b());
                  return !op.dst.has_error();
              }),
    on_pixels("deepholdout", 2, "Hold out the first deep image by the second",
              [](Op& op) {
                  op.dst = IBA::deep_holdout(op.a(), op.b());
                  return !op.dst.has_error();
              }),
    on_pixels("deepen", 1, "From flat to deep",
              [](Op& op) { return IBA::deepen(op.dst, op.a(), op.number("z", 1)); })
        .modifier("z", "X", "depth where there is no Z channel (1)"),
    on_pixels("flatten", 1, "From deep to flat", of_one<IBA::flatten>),
    on_pixels("pastemeta", 2, "The pixels of the second image with the metadata of the first",
              paste_metadata),
    command(
        "paste +X+Y",
        "Paste the first image over the second, at an offset or where its window lies (auto, -)",
        run_paste)
        .images(0, kAnyNumber)
        .modifier("all", "0|1", "all images of the stack over the last")
        .modifier("mergeroi", "0|1", "a data window that holds both"),
    command("mosaic WxH", "Assemble images into columns and rows", run_mosaic)
        .images(0, kAnyNumber)
        .modifier("pad", "N", "pixels between images (0)")
        .modifier("fit", "WxH", "fit each image to this size first"),
};

} // namespace

Rows composite_commands() {
    return kCompositeRows;
}

} // namespace tonetool::chain
