// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/ancestry.h"

#include <functional>

#include "tonetool/parts.h"

namespace tonetool::chain {

namespace {

// Of images that are made of files alone.
void note_lineage(const Session& session, const Call& call, size_t first) {
    std::string of_popped;
    for (const ImagePtr& image : call.images) {
        if (image->lineage == 0)
            return;
        of_popped += std::to_string(image->lineage) + ' ';
    }
    for (size_t i = first; i < session.stack.images.size() && !of_popped.empty(); ++i) {
        Image& made = *session.stack.images[i];
        if (made.lineage == 0) {
            made.lineage = std::hash<std::string>()(of_popped + call.quoted_words() + ' ' +
                                                    std::to_string(i - first));
        }
    }
}

bool has_picture_beside(const Part& kept, const Part& other) {
    PartChoice choice;
    std::string ignored;
    return ToneAlgo::find_part({kept.header(), other.header()}, {}, choice, ignored) &&
           (choice.part == 1 || !choice.left_out.empty());
}

// Most commands work on the first part of an image, and its others are gone.
void note_left_out(Image& made, const Image& from) {
    made.left_out.insert(from.left_out.begin(), from.left_out.end());
    for (size_t p = made.part_count(); p < from.part_count(); ++p) {
        if (has_picture_beside(from.part(), from.part(p))) {
            const std::string name =
                from.part(p).header().get_string_attribute("oiio:subimagename");
            made.left_out.insert(name.empty() ? "subimage " + std::to_string(p) : name);
        }
    }
}

// The picture is the one that was asked for.
bool chooses_a_part(const Call& call) {
    return call.row().names.front() == "subimage" || call.has("layer");
}

} // namespace

void note_ancestry(const Session& session, const Call& call, size_t first) {
    note_lineage(session, call, first);
    if (call.row().group == Group::Compare || chooses_a_part(call))
        return;
    for (size_t i = first; i < session.stack.images.size(); ++i) {
        for (const ImagePtr& from : call.images)
            if (from != session.stack.images[i])
                note_left_out(*session.stack.images[i], *from);
    }
}

} // namespace tonetool::chain
