// SPDX-License-Identifier: BSD-3-Clause
// Commands that choose channels, subimages and MIP levels, and count pixels.
#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "chain/commands/commands.h"
#include "chain/images/channels.h"
#include "chain/session/ops.h"

namespace tonetool::chain {

namespace {

bool ch(Op& op) {
    const auto warn = [&op](const std::string& text) {
        op.session.warning("--ch", text); // twice, as oiiotool
        op.session.warning("--ch", text);
    };
    op.dst = select_channels(op.a(), op.call.argument(0),
                             op.session.settings.compat ? Warn(warn) : nullptr);
    return !op.dst.has_error();
}

void push_parts(Session& session, const std::string& name, std::vector<PartPtr> parts) {
    session.stack.push(std::make_shared<Image>(name, std::move(parts)));
}

void run_subimage(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    auto index = std::ptrdiff_t(image.find_part(call.argument(0), session.settings.compat));
    std::vector<PartPtr> parts = image.parts();
    if (call.flag("delete", false))
        parts.erase(parts.begin() + index);
    else
        parts = {parts[size_t(index)]};
    if (parts.empty())
        throw CommandError("cannot delete the only subimage of " + image.name());
    push_parts(session, image.name(), std::move(parts));
}

void run_sisplit(Session& session, const Call& call) {
    for (const PartPtr& part : call.images[0]->parts())
        push_parts(session, call.images[0]->name(), {part});
}

void push_appended(Session& session, const std::vector<ImagePtr>& images) {
    std::vector<PartPtr> parts;
    for (const ImagePtr& image : images)
        parts.insert(parts.end(), image->parts().begin(), image->parts().end());
    push_parts(session, images.front()->name(), std::move(parts));
}

void push_level(Session& session, const Image& image, int level) {
    std::vector<PartPtr> parts;
    for (const PartPtr& part : image.parts()) {
        const int levels = part->mip_levels();
        if (levels > 1 && level >= levels) {
            throw CommandError("Selecting MIP level " + std::to_string(level) + " of subimage " +
                               std::to_string(parts.size()) + ", which has only " +
                               std::to_string(levels) + " MIP levels");
        }
        parts.push_back(levels > 1 ? Part::of_level(part, level) : part);
    }
    push_parts(session, image.name(), std::move(parts));
}

// Prints lines about the values of the first subimage.
template <class Lines>
void run_count(Session& session, const Call& call, Lines lines) {
    OIIO::ImageBuf none;
    lines(Op{session, call, none, {&call.images[0]->part().pixels()}});
    session.outcome.produced = true;
    session.stack.push(call.images[0]);
}

void print_count(Session& session, OIIO::imagesize_t count, const std::string& of) {
    session.print(OIIO::Strutil::fmt::format("{:8}  {}", count, of));
}

void colorcount(const Op& op) {
    // oiiotool accepts a colon between colours as well as the semicolon of its help.
    std::string list = op.call.argument(0);
    std::replace(list.begin(), list.end(), ';', ':');
    const Strings colors = split(list, ':');
    Floats values;
    for (const std::string& color : colors) {
        const Floats one = op.per_channel("COLORLIST", color, 0);
        values.insert(values.end(), one.begin(), one.end());
    }
    std::vector<OIIO::imagesize_t> counts(colors.size());
    if (!IBA::color_count(op.a(), counts.data(), int(colors.size()), values,
                          op.values("eps", 0.001F)))
        throw CommandError(op.a().geterror());
    for (size_t i = 0; i < colors.size(); ++i)
        print_count(op.session, counts[i], colors[i]);
}

void rangecheck(const Op& op) {
    OIIO::imagesize_t below = 0, above = 0, within = 0;
    const std::string &low = op.call.argument(0), &high = op.call.argument(1);
    if (!IBA::color_range_check(op.a(), &below, &above, &within, op.per_channel("MIN", low, 0),
                                op.per_channel("MAX", high, 1)))
        throw CommandError(op.a().geterror());
    print_count(op.session, below, "< " + low);
    print_count(op.session, above, "> " + high);
    print_count(op.session, within, "within range");
}

// n= of commands that join images.
int count_of(const Call& call) {
    return call.integer("n", {1, 1000}).value_or(call.row().pops);
}

const Modifiers kCount = {{"n", "N", "number of images (2)"}};

const Rows kChannelsRows = {
    on_pixels("ch CHANLIST", 1,
              "Select or shuffle channels (\"R,G,B\", \"2,1,0\", \"R,G=0.5,B,A=1.0\")", ch,
              Scope::Levels)
        .operation(""),
    on_pixels("chappend", 2, "Join the channels of the last two images (or n=)",
              [](Op& op) {
                  op.dst.copy(op.a());
                  for (size_t i = 1; i < op.src.size(); ++i)
                      op.dst = IBA::channel_append(op.dst, *op.src[i]);
                  return !op.dst.has_error();
              })
        .images_of(count_of)
        .modifiers(kCount)
        .operation(""),
    command("subimage INDEX", "Select one subimage by index or name", run_subimage)
        .images(1, 1)
        .modifier("delete", "0|1", "keep all but this one"),
    command("sisplit", "Split the subimages into images", run_sisplit).images(1, kAnyNumber),
    command("siappend", "Join the subimages of the last two images (or n=)",
            [](Session& session, const Call& call) { push_appended(session, call.images); })
        .images(2, 1)
        .images_of(count_of)
        .modifiers(kCount),
    command("siappendall", "Join the subimages of all images of the stack",
            [](Session& session, const Call&) { push_appended(session, take_images(session, 0)); })
        .images(0, kAnyNumber),
    command("selectmip MIPLEVEL", "Select one MIP level (0: the largest)",
            [](Session& session, const Call& call) {
                OIIO::ImageBuf none;
                push_level(session, *call.images[0], Op{session, call, none, {}}.integer(0));
            })
        .images(1, 1),
    command("unmip", "Keep only the largest MIP level",
            [](Session& session, const Call& call) { push_level(session, *call.images[0], 0); })
        .images(1, 1),
    command("colorcount COLORLIST", "Count the pixels of each colour (COLOR:COLOR:...)",
            [](Session& session, const Call& call) { run_count(session, call, colorcount); })
        .in(Group::Print)
        .images(1, 1)
        .modifier("eps", "VALUES", "tolerance of a match (0.001)"),
    command("rangecheck MIN MAX", "Count the pixels outside a range of values",
            [](Session& session, const Call& call) { run_count(session, call, rangecheck); })
        .in(Group::Print)
        .images(1, 1),
};

} // namespace

Rows channel_commands() {
    return kChannelsRows;
}

} // namespace tonetool::chain
