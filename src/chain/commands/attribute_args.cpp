// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/attribute_args.h"

#include "chain/commands/color_input.h"
#include "chain/commands/flip_report.h"
#include "sequence/results/attribution.h"
#include "text/error.h"
#include "text/printable.h"

namespace tonetool::chain {

namespace {

std::string view_of(const OIIO::ImageSpec& header) {
    return std::string(header.get_string_attribute("view"));
}

// The part of a file that was compared, and behind it all others of its view, so that layers are
// found wherever they are.
struct AllParts {
    AllParts(const Image& image, const PixelOptions& pixels) {
        const std::vector<OIIO::ImageSpec> headers = headers_of(image);
        PartChoice choice;
        std::string ignored; // the command itself has found it
        (void)ToneAlgo::find_part(headers, pixels, choice, ignored);
        const auto chosen = size_t(choice.part);
        (void)ToneAlgo::find_color(headers.at(chosen), pixels, color, ignored);
        images.push_back(image.part(chosen).color_source());
        for (size_t i = 0; i < headers.size(); ++i)
            if (i != chosen && view_of(headers[i]) == view_of(headers[chosen]))
                images.push_back(image.part(i).color_source());
        for (const OIIO::ImageBuf& part : images)
            pointers.push_back(&part);
    }
    ColorChoice color;
    std::vector<OIIO::ImageBuf> images;
    std::vector<const OIIO::ImageBuf*> pointers;
};

} // namespace

Modifiers attribute_modifiers() {
    return {{"attribute", "0|1|replace",
             "whose error is it: by light groups, Cryptomatte and other layers; replace: without "
             "what each group does alone, in half the time"}};
}

std::optional<AttributeOptions> attribute_options(const Call& call, const HdrFlipOptions& options,
                                                  const std::string& metric) {
    const std::string asked = call.choice("attribute", {"0", "1", "replace"}).value_or("0");
    if (asked == "0")
        return std::nullopt;
    if (options.size == SizePolicy::Resize)
        throw CommandError("attribute= goes without resize=1: ids cannot be resized");
    AttributeOptions attributed;
    static_cast<HdrFlipOptions&>(attributed) = options;
    attributed.metric = metric;
    attributed.alone = asked != "replace";
    return attributed;
}

std::optional<AttributeOptions> attribute_options(const Call& call, const ErrorOptions& options) {
    HdrFlipOptions flip;
    static_cast<PairOptions&>(flip) = options;
    flip.start_exposure = options.start_exposure;
    flip.stop_exposure = options.stop_exposure;
    flip.num_exposures = options.num_exposures;
    std::optional<AttributeOptions> attributed = attribute_options(call, flip, options.metric);
    if (attributed)
        attributed->eps = options.eps;
    return attributed;
}

void attribute_error(Session& session, const Call& call,
                     const std::optional<AttributeOptions>& options, const OIIO::ImageBuf& map,
                     size_t test) {
    if (!options)
        return;
    const Image &reference = *call.images.front(), &image = *call.images.at(test + 1);
    const AllParts references(reference, options->pixels), tests(image, options->pixels);
    AttributeOptions named = *options;
    if (!named.pixels.layer.empty()) // which may be the name of a part or a view
        named.pixels.layer = references.color.layer;
    AttributeResult found;
    std::string why;
    if (!ToneAlgo::attribute(found, references.pointers, tests.pointers, why, named, &map))
        throw CommandError("attribute: \"" + reference.name() + "\", \"" + image.name() +
                           "\": " + why);
    const std::string label = call.row().label();
    for (const std::string& warning : found.warnings)
        session.warning(label, "attribute: " + printable(warning));
    const std::string where =
        session.frame.loops ? " (" + printable(image.name()) + ")" : std::string();
    for (const std::string& sentence : ToneAlgo::attribute_findings(found))
        if (call.flag("print", true))
            session.report(label + ": " + printable(sentence) + where);
    if (session.check.result)
        session.check.result->measurements.back().attribution = sequence::attribution_json(found);
}

} // namespace tonetool::chain
