// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/comparing.h"

#include <algorithm>

#include "chain/commands/color_input.h"
#include "chain/commands/frame_pictures.h"
#include "imagebuf/pixels/upright.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

// The same pixels twice: most likely a slip of the command line.
void warn_of_same_file(Session& session, const Call& call, const Image& test, const Look& look) {
    const Image& reference = *call.images.front();
    const auto r = looked_at(reference, look.reference), t = looked_at(test, look.tests);
    if (r && t && same_file(reference, r->part, test, t->part) && r->color.r == t->color.r &&
        r->color.g == t->color.g && r->color.b == t->color.b) {
        tell_same_file(session, call, reference, test,
                       "reference \"" + reference.name() + "\" and test \"" + test.name() +
                           "\" are the same file");
    }
}

// What a function says, without its name, which is the command's, and with those of the files.
std::string said_of(const Call& call, std::string error) {
    const size_t name = error.find_first_not_of("abcdefghijklmnopqrstuvwxyz_");
    if (name != std::string::npos && name > 0 && error.compare(name, 2, ": ") == 0)
        error.erase(0, name + 2);
    const auto& images = call.images;
    if (std::any_of(images.begin(), images.end(), [&](const ImagePtr& image) {
            return error.find(image->name()) != std::string::npos;
        }))
        return error;
    error += " (reference \"" + images.front()->name() + "\", test";
    for (size_t i = 1; i < images.size(); ++i)
        error += (i == 1 ? " \"" : ", \"") + images[i]->name() + "\"";
    return error + ")";
}

} // namespace

Look same_look(const Call& call, bool again) {
    return {pixel_options(call), pixel_options(call), true, again};
}

Compared compare_tests(Session& session, const Call& call, const Look& look,
                       const CompareFunction& function) {
    Compared done;
    const auto view = shown_bytes(session, call) > 0               ? shown_input
                      : look.again && session.settings.memory == 0 ? color_input
                                                                   : color_source;
    done.views.reserve(call.images.size()); // else the pixels are copied
    for (const ImagePtr& image : call.images) {
        const PixelOptions& options = done.views.empty() ? look.reference : look.tests;
        done.views.push_back(view(session, call, *image, options));
    }
    Tests tests;
    for (size_t i = 1; i < done.views.size(); ++i) {
        warn_of_same_file(session, call, *call.images[i], look);
        if (look.alike)
            check_same_picture(session, call, *call.images.front(), look.reference, *call.images[i],
                               look.tests);
        tests.push_back(&done.views[i]);
    }
    done.maps.resize(tests.size());
    if (!function(done.maps, done.views.front(), tests))
        throw CommandError(said_of(call, done.maps.front().geterror()));
    session.outcome.produced = true;
    return done;
}

sequence::PictureRequest pair_request(const Views& views, size_t test) {
    sequence::PictureRequest request;
    request.reference = &views.at(0);
    request.test = &views.at(test + 1);
    return request;
}

void push_result(Session& session, const Call& call, OIIO::ImageBuf result) {
    session.stack.push(Image::computed("--" + call.row().label(), std::move(result)));
}

void push_map(Session& session, const Call& call, OIIO::ImageBuf map) {
    lie_as(call.images.front()->part().header(), map);
    push_result(session, call, std::move(map));
}

int test_count(const Call& call) {
    return call.integer("tests", {1, 1000}).value_or(1);
}

int compared_pops(const Call& call) {
    return 1 + test_count(call);
}

} // namespace tonetool::chain
