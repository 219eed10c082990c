// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/execute.h"

#include <OpenImageIO/filesystem.h>
#include <algorithm>

#include "chain/session/ancestry.h"
#include "chain/session/ops.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

// OpenImageIO ends the process where these get depth samples.
void refuse_deep(const Session& session, const Call& call) {
    static const Strings flat_only = {"resample",   "transpose", "fft",      "maxchan",
                                      "minchan",    "chsum",     "colormap", "colorcount",
                                      "rangecheck", "pdiff"};
    const std::string& name = call.row().names.front();
    if (std::find(flat_only.begin(), flat_only.end(), name) == flat_only.end())
        return;
    for (const ImagePtr& image : call.images) {
        const Chosen chosen = chosen_subimages(session, call, *image);
        for (size_t s = 0; s < chosen.count; ++s) {
            if (chosen.active[s] && image->part(s).header().deep) {
                throw CommandError(session.settings.compat
                                       ? "deep images not supported"
                                       : "\"" + image->name() +
                                             "\" is deep, which this command cannot use "
                                             "(--flatten makes it flat)");
            }
        }
    }
}

// Commands run as far as their images go.
void refuse_absent(const Session& session, const Call& call) {
    if (call.row().group == Group::Stack || call.row().names.front() == "against")
        return;
    for (const ImagePtr& image : call.images)
        if (image->absent)
            throw CommandError(session.check.why_absent.empty()
                                   ? "no file \"" + image->name() + "\""
                                   : session.check.why_absent);
}

} // namespace

void execute(Session& session, Call& call) {
    const std::vector<ImagePtr>& stack = session.stack.images;
    call.images = session.stack.pop(size_t(call.pops()));
    for (const ImagePtr& image : call.images) {
        image->used = true;
        image->worked_on |= call.row().group != Group::Stack && call.row().group != Group::Print;
        if (call.row().group != Group::Stack)
            session.note_format(*image);
    }
    refuse_absent(session, call);
    refuse_deep(session, call);
    const size_t below = stack.size();
    const size_t expected = below + static_cast<size_t>(call.pushes());
    call.row().run(session, call);
    note_ancestry(session, call, below);
    if (call.pushes() != kAnyNumber && stack.size() != expected)
        throw CommandError("internal error: wrong number of images on the stack");
}

// Files that a command reads are where the policy says.
void locate_files(Session& session, const Command& row, Token& token, Strings& arguments) {
    for (size_t i = 0; i < arguments.size() && i < row.args.size() && !row.writes(); ++i)
        if (names_file(row.args[i]))
            arguments[i] = session.file(arguments[i]);
    for (auto& [key, value] : token.modifiers) {
        for (const Modifier& modifier : row.modifiers) {
            if (modifier.key == key && value_names_file(modifier, value)) {
                const std::string path = session.file(value);
                const bool layer = modifier.hint != "FILE" && modifier.hint != kCurveHint &&
                                   !OIIO::Filesystem::is_regular(path);
                value = layer ? value : path;
            }
        }
    }
}

void run_command(Session& session, const std::string& word, Strings arguments) {
    Token token = parse_token("--" + word, session.settings.compat);
    const Command* row = find_command(token.name);
    if (!row)
        throw CommandError("internal error: no command " + word);
    Call call(*row, std::move(token), std::move(arguments), session.settings.compat);
    execute(session, call);
}

} // namespace tonetool::chain
