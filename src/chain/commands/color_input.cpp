// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/color_input.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "text/error.h"
#include "tonetool/color_tags.h"

namespace tonetool::chain {

namespace {

void check_header(const Image& image, const OIIO::ImageSpec& header, const PixelOptions& options) {
    ColorChoice choice;
    std::string why;
    if (!ToneAlgo::find_color(header, options, choice, why))
        throw CommandError("\"" + image.name() + "\": " + why);
}

void refuse_all(const Image& image) {
    if (image.part_count() > 1 || image.part().mip_levels() > 1) {
        throw CommandError("\"" + image.name() + "\" has " + std::to_string(image.part_count()) +
                           " subimage(s) of " + std::to_string(image.part().mip_levels()) +
                           " MIP level(s), of which one is compared: not with -a (valid: without "
                           "-a, a command for each subimage with layer=)");
    }
}

bool is_judged(const Session& session, const Call& call) {
    return call.row().group == Group::Compare && (call.has("fail") || call.has("warn") ||
                                                  call.row().always_judges || session.check.result);
}

std::string left_out(const Image& image, const PartChoice& choice) {
    const std::string chosen =
        choice.picture.empty() ? "subimage " + std::to_string(choice.part) : choice.picture;
    return "\"" + image.name() + "\": beside " + chosen +
           ", pictures are not looked at: " + join(choice.left_out, ", ") +
           " (layer= chooses one, or --subimage)";
}

} // namespace

std::vector<OIIO::ImageSpec> headers_of(const Image& image) {
    std::vector<OIIO::ImageSpec> headers;
    for (const PartPtr& part : image.parts())
        headers.push_back(part->header());
    return headers;
}

bool same_file(const Image& a, size_t part_of_a, const Image& b, size_t part_of_b) {
    std::error_code ignored;
    const Part &of_a = a.part(part_of_a), &of_b = b.part(part_of_b);
    const bool one_file =
        of_a.from_file() && of_b.from_file() && of_a.subimage() == of_b.subimage() &&
        of_a.header().channelnames == of_b.header().channelnames &&
        (a.name() == b.name() || std::filesystem::equivalent(a.name(), b.name(), ignored));
    return part_of_a == part_of_b && (one_file || (a.lineage != 0 && a.lineage == b.lineage));
}

void tell_same_file(Session& session, const Call& call, const Image& a, const Image& b,
                    const std::string& text) {
    const auto plain = [](const Image& image) {
        std::error_code none;
        return std::filesystem::absolute(image.name(), none).lexically_normal();
    };
    if (session.frame.loops && session.check.result && plain(a) == plain(b))
        throw CommandError(text + " (valid: the names of two versions)");
    session.warning(call.row().label(), text);
}

void tell_encoding(Session& session, const Call& call, const Image& image,
                   const OIIO::ImageSpec& header, const PixelOptions& options) {
    const std::string where = call.row().label(), named = "\"" + image.name() + "\": ";
    const double gamma = options.from.empty() ? stated_gamma(header) : 0;
    if (gamma > 0 && header.find_attribute("oiio:Gamma")) {
        session.report(where + ": " + named + "its gamma of " + format_number(gamma) +
                       " is applied instead of sRGB's curve");
    }
    if (const double exposure = stated_exposure(header); exposure != 1) {
        session.report(where + ": " + named + "its EXPOSURE of " + format_number(exposure) +
                       " is divided out");
    }
    if (const auto profile = unapplied_profile(header); profile && options.from.empty()) {
        session.warning(where, named + "its ICC profile (" + *profile +
                                   ") is not applied: the colours are read as those of sRGB "
                                   "(from= says what they are)");
    }
}

void check_nothing_left_out(const Image& image) {
    if (!image.left_out.empty()) {
        throw CommandError("\"" + image.name() +
                           "\": a command before this one has left out parts with a picture: " +
                           join({image.left_out.begin(), image.left_out.end()}, ", ") +
                           " (valid: --subimage NAME behind the file, to choose one, or -a)");
    }
}

Part& color_part(Session& session, const Call& call, const Image& image,
                 const PixelOptions& options) {
    const bool compares = call.row().group == Group::Compare;
    if (compares && session.settings.all_subimages && options.layer.empty())
        refuse_all(image);
    const bool judged = is_judged(session, call);
    if (judged)
        check_nothing_left_out(image);
    PartChoice choice;
    std::string why;
    if (!ToneAlgo::find_part(headers_of(image), options, choice, why))
        throw CommandError("\"" + image.name() + "\": " + why);
    if (!choice.left_out.empty()) {
        const std::string text = left_out(image, choice);
        if (judged)
            throw CommandError(text);
        session.warning(call.row().label(), text);
    }
    Part& part = image.part(size_t(choice.part));
    if (compares && part.mip_levels() > 1) {
        session.warning(call.row().label(),
                        "\"" + image.name() + "\": of its " + std::to_string(part.mip_levels()) +
                            " MIP levels the largest is looked at (--selectmip chooses another, "
                            "--diff compares all)");
    }
    return part;
}

Part& checked_part(Session& session, const Call& call, const Image& image,
                   const PixelOptions& options) {
    Part& part = color_part(session, call, image, options);
    OIIO::ImageSpec header = part.header();
    if (part.integer_encoded())
        header.format = part.format().value_or(DataFormat{OIIO::TypeUInt8, {}, 0}).type;
    check_header(image, header, options);
    // The tag must be a known one also for integer files, where the library would take any tag for
    // sRGB.
    if (header.find_attribute("oiio:ColorSpace") && header.format != OIIO::TypeFloat) {
        header.set_format(OIIO::TypeFloat);
        check_header(image, header, options);
    }
    tell_encoding(session, call, image, part.header(), options);
    return part;
}

std::optional<LookedAt> looked_at(const Image& image, const PixelOptions& options) {
    std::vector<OIIO::ImageSpec> headers = headers_of(image);
    PartChoice part;
    LookedAt found;
    std::string ignored;
    if (!ToneAlgo::find_part(headers, options, part, ignored))
        return std::nullopt;
    found.part = size_t(part.part);
    found.header = std::move(headers.at(found.part));
    if (!ToneAlgo::find_color(found.header, options, found.color, ignored))
        return std::nullopt;
    return found;
}

void push_picture(Session& session, const Image& image, const PixelOptions& options,
                  OIIO::ImageBuf result) {
    PartChoice choice;
    std::string ignored;
    ImagePtr derived = Image::derived(image, std::move(result));
    if (session.settings.all_subimages && image.part_count() > 1 &&
        ToneAlgo::find_part(headers_of(image), options, choice, ignored)) {
        std::vector<PartPtr> parts = image.parts();
        parts.at(size_t(choice.part)) = derived->parts().front();
        derived = std::make_shared<Image>(image.name(), std::move(parts));
    }
    session.stack.push(derived);
}

void check_same_picture(Session& session, const Call& call, const Image& reference,
                        const PixelOptions& of_reference, const Image& test,
                        const PixelOptions& of_test) {
    if (!of_reference.layer.empty() || !of_test.layer.empty())
        return;
    const auto r = looked_at(reference, of_reference), t = looked_at(test, of_test);
    if (!r || !t || r->color.layer == t->color.layer)
        return;
    const auto name = [](const LookedAt& of) {
        return of.color.layer.empty() ? std::string("R,G,B") : of.color.layer;
    };
    const auto has = [](const LookedAt& of, const std::string& layer) {
        const Strings layers = ToneAlgo::color_layers(of.header);
        return std::find(layers.begin(), layers.end(), layer) != layers.end();
    };
    const bool test_has_both = has(*t, name(*r));
    if (!test_has_both && !has(*r, name(*t)))
        return; // a picture that was written out on its own
    const std::string layer = name(test_has_both ? *r : *t);
    const std::string text = "the picture of \"" + reference.name() + "\" is " + name(*r) +
                             ", that of \"" + test.name() + "\" " + name(*t) + ", and both have " +
                             layer + " (layer=" + layer + " compares that)";
    if (is_judged(session, call))
        throw CommandError(text);
    session.warning(call.row().label(), text);
}

OIIO::ImageBuf color_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options) {
    return checked_part(session, call, image, options).color_view();
}

OIIO::ImageBuf color_source(Session& session, const Call& call, const Image& image,
                            const PixelOptions& options) {
    return checked_part(session, call, image, options).color_source();
}

} // namespace tonetool::chain
