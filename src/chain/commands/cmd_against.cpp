// SPDX-License-Identifier: BSD-3-Clause
// --against: a file compared with its approved version, layer by layer.
#include <algorithm>

#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/fault_args.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/frame_pictures.h"
#include "imagebuf/pixels/names.h"
#include "sequence/against/against.h"
#include "text/error.h"
#include "tonetool/against.h"

namespace tonetool::chain {

namespace {

Strings words_of(const Call& call, const std::string& key) {
    const auto text = call.text(key);
    Strings words = text ? split(*text, ',') : Strings();
    for (std::string& word : words)
        word = OIIO::Strutil::strip(word);
    return words;
}

// kind=LAYER=KIND,...
void read_kinds(const Call& call, AgainstOptions& options) {
    for (const std::string& word : words_of(call, "kind")) {
        const size_t equals = word.rfind('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
            throw CommandError("kind is \"" + word + "\": must be LAYER=KIND (valid kinds: " +
                               OIIO::Strutil::join(ToneAlgo::against_kinds(), ", ") + ")");
        options.kinds.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
}

struct Source {
    std::vector<OIIO::ImageBuf> parts;
    std::vector<const OIIO::ImageBuf*> pointers;
};

Source source_of(const Image& image) {
    if (image.is_result) {
        throw CommandError("\"" + image.name() +
                           "\" is what a comparison has made, no render (valid: "
                           "--against before the comparison)");
    }
    Source source;
    for (const PartPtr& part : image.parts())
        source.parts.push_back(part->color_source());
    for (const OIIO::ImageBuf& part : source.parts)
        source.pointers.push_back(&part);
    return source;
}

// Marks the places of the faults in the pictures of the pair.
void show_differences(Session& session, const Call& call, const sequence::AgainstRecord& record) {
    if (!session.check.painter)
        return;
    const sequence::FrameResult before = *session.check.result;
    std::vector<sequence::Fault> found = sequence::against_faults(record);
    sequence::PictureRequest request;
    for (const sequence::Fault& fault : found)
        if (fault.position)
            request.spots.push_back(*fault.position);
    session.check.result->faults.insert(session.check.result->faults.end(), found.begin(),
                                        found.end());
    request.look.pixels = pixel_options(call);
    const OIIO::ImageBuf approved =
        shown_input(session, call, *call.images[0], request.look.pixels);
    const OIIO::ImageBuf picture = shown_input(session, call, *call.images[1], request.look.pixels);
    request.reference = &approved;
    request.test = &picture;
    request.compared = false;
    show(session, call, std::move(request));
    *session.check.result = before;
}

// What of the command's words can be wrong, before any image is read.
void check_words(Session&, const Call& call) {
    (void)fault_limits(call, sequence::against_rules());
    AgainstOptions options;
    read_kinds(call, options);
    const std::vector<std::string> valid = ToneAlgo::against_kinds();
    for (const auto& [layer, kind] : options.kinds)
        if (std::find(valid.begin(), valid.end(), kind) == valid.end())
            throw CommandError("layer " + layer + ": " + unknown_name("kind", kind, valid));
}

// What is to agree must be there: a name that neither header has holds nothing.
void check_attributes(const AgainstFacts& facts, const Strings& names) {
    Strings there;
    for (const AgainstFile* file : {&facts.approved, &facts.file})
        for (const QcPart& part : file->parts)
            for (const auto& [name, value] : part.metadata)
                there.push_back(name);
    for (const std::string& name : names)
        if (std::find(there.begin(), there.end(), name) == there.end())
            throw CommandError("attribute: neither header has \"" + name + "\"" +
                               meant(name, there));
}

void run_against(Session& session, const Call& call) {
    const Image &approved = *call.images[0], &image = *call.images[1];
    const sequence::FaultLimits limits = fault_limits(call, sequence::against_rules());
    session.stack.push(call.images[0]);
    session.stack.push(call.images[1]);
    session.outcome.produced = true;
    if (!session.check.result)
        return; // this run only measures the exposures of the shot
    if (approved.absent) {
        sequence::AgainstRecord record;
        record.approved = false;
        record.between = session.check.between;
        record.limits = limits;
        session.check.result->against = sequence::to_json(record);
        return;
    }
    if (same_file(approved, 0, image, 0)) { // most likely a slip of the command line
        tell_same_file(session, call, approved, image,
                       "approved \"" + approved.name() + "\" and new \"" + image.name() +
                           "\" are the same file");
    }
    AgainstOptions options;
    options.pixels = pixel_options(call);
    read_kinds(call, options);
    options.skip = words_of(call, "skip");
    const Source theirs = source_of(approved), ours = source_of(image);
    AgainstFacts facts;
    std::string why;
    if (!ToneAlgo::against_facts(facts, theirs.pointers, ours.pointers, why, options))
        throw CommandError("\"" + approved.name() + "\", \"" + image.name() + "\": " + why);
    if (facts.layers.empty())
        throw CommandError("\"" + approved.name() + "\" and \"" + image.name() +
                           "\" have no layer in common that is compared");
    for (const std::string& pattern : facts.unused)
        session.warning(call.row().label(), "no layer is called \"" + pattern + "\"");
    take_types(approved, facts.approved.channels);
    take_types(image, facts.file.channels);
    const Strings attributes = words_of(call, "attribute");
    check_attributes(facts, attributes);
    sequence::AgainstRecord record = sequence::record_of(facts, attributes);
    record.limits = limits;
    session.check.result->against = sequence::to_json(record);
    show_differences(session, call, record);
}

Modifiers own_modifiers() {
    return {{"kind", "LAYER=KIND,...",
             "what layers hold where their names do not tell: position, normal, depth, vector, id, "
             "albedo, color, group or data"},
            {"skip", "LAYER,...", "layers that are not compared, with * and ?"},
            {"attribute", "NAME,...", "more attributes of the header that must agree"}};
}

} // namespace

Rows against_commands() {
    return {
        command(
            "against",
            "Compare each layer with the approved version; severities: off, info, warning, error",
            run_against)
            .checked(check_words)
            .images(2, 2)
            .modifiers(pixel_modifiers(), own_modifiers(),
                       fault_modifiers(sequence::against_rules()))};
}

} // namespace tonetool::chain
