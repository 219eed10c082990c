// SPDX-License-Identifier: BSD-3-Clause
#include "runs/frame_scan.h"

#include <OpenImageIO/sysutil.h>
#include <algorithm>

#include "chain/language/values.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

using chain::Word;

// The numbers of frames that hold for the whole line.
void take_frames(Scan& scan, const std::string& range) {
    if (!scan.options.frames.empty() && !scan.plan.line.compat) {
        throw CommandError("--frames is given twice: " + scan.options.frames + " and " + range +
                           " (valid: once, as " + scan.options.frames + "," + range + ")");
    }
    scan.options.frames = range;
}

int jobs_given(const std::string* number) {
    return number ? checked_integer("N", *number, {1, 1024})
                  : int(std::max(1U, OIIO::Sysutil::hardware_concurrency()));
}

// The settings that hold for the whole line; true if the word is one that may have an argument.
bool take_setting(Scan& scan, const Word& word) {
    const std::string* argument =
        word.arguments.empty() ? nullptr : &scan.texts()[word.arguments.front()];
    FramePlan& plan = scan.plan;
    plan.skip_bad |= word.is("skip-bad-frames");
    plan.warnings_exit |= word.is("warnings-exit");
    plan.verbose = (word.is("v") || plan.verbose) && !word.is("q");
    plan.quiet = (word.is("q") || plan.quiet) && !word.is("v");
    if (word.is("progress") && word.token.value == Strings{"json"})
        plan.progress = "json";
    if (word.is("parallel-frames"))
        plan.parallel = jobs_given(argument);
    else if (word.is("frames") && argument)
        take_frames(scan, *argument);
    else if (word.is("framepadding") && argument)
        scan.options.padding = checked_integer("DIGITS", *argument, {1, 9});
    else if (word.is("views") && argument)
        scan.options.views = split(scan.views.emplace(*argument), ',');
    else
        return false;
    return true;
}

bool is_wildcard(const Scan& scan, const std::string& text) {
    return sequence::is_pattern(text) || (scan.options.names && sequence::has_names(text));
}

// -o:all=1 has wildcards of its own.
void take_patterns(Scan& scan, const Word& word) {
    const auto& modifiers = word.token.modifiers;
    const bool output = word.row && word.row->group == chain::Group::Write && word.row->writes();
    const bool all = std::any_of(modifiers.begin(), modifiers.end(),
                                 [](const auto& modifier) { return modifier.first == "all"; });
    for (size_t at = word.at; at < word.end(); ++at) {
        const bool written = output && at == word.at + 1;
        if (!word.wildcards)
            scan.same.push_back(at);
        else if (!(written && all) && is_wildcard(scan, scan.texts()[at]))
            scan.patterns.push_back({at, written});
    }
}

// Whether a frame's images may be others than the next one's, though none that is read has a
// wildcard. What is written or printed makes no difference.
bool may_vary(const chain::ParsedLine& line, bool also_by_wildcard) {
    const auto varies = [also_by_wildcard](const std::string& text) {
        return text.find("FRAME_NUMBER") != std::string::npos ||
               (also_by_wildcard && sequence::is_pattern(text));
    };
    const auto word_varies = [&](const Word& word) {
        const chain::Command* row = word.row;
        if (row && (row->writes() || row->group == chain::Group::Write || word.is("echo")))
            return false;
        for (const auto& [key, text] : word.token.modifiers)
            if (row && !row->writes_to(key) && varies(text))
                return true;
        return (!row && varies(line.texts[word.at])) ||
               std::any_of(word.arguments.begin(), word.arguments.end(),
                           [&](size_t at) { return varies(line.texts[at]); });
    };
    return std::any_of(line.words.begin(), line.words.end(), word_varies);
}

} // namespace

void check_range_is_used(const Scan& scan, const std::vector<sequence::Side>& sides) {
    const std::vector<size_t>& inputs = scan.plan.check.inputs;
    if (scan.options.frames.empty())
        return;
    if (sides.empty() && !may_vary(scan.plan.line, inputs.empty())) {
        throw CommandError(
            "--frames " + scan.options.frames + ": " +
            (inputs.empty()
                 ? "nothing that makes an image depends on the frame, so all would be "
                   "the same (valid: an image that is read with # in its name, "
                   "{FRAME_NUMBER}, or no --frames)"
                 : "no image that is read has a wildcard, so each frame would be the "
                   "same as \"" +
                       scan.texts()[inputs.front()] + "\" (valid: # in the name, or no --frames)"));
    }
    const auto numbers = sequence::parse_frames(scan.options.frames, scan.options.lenient);
    for (const sequence::Side& side : sides) {
        std::vector<int> own;
        for (const sequence::Item& item : side.files.items)
            own.push_back(item.frame);
        if (!side.files.own_range || own == numbers)
            return;
    }
    if (!sides.empty()) {
        throw CommandError("--frames " + scan.options.frames + " holds for no name: \"" +
                           sides.front().pattern +
                           "\" has a range of its own (valid: one of them)");
    }
}

Scan scan_line(chain::ParsedLine line, bool for_images) {
    Scan scan;
    scan.plan.line = std::move(line);
    scan.for_images = for_images;
    scan.options.names = !scan.plan.line.compat && !for_images;
    for (const Word& word : scan.plan.line.words)
        if (!take_setting(scan, word))
            take_patterns(scan, word);
    return scan;
}

std::vector<sequence::Item> frames_given(const Scan& scan) {
    std::vector<sequence::Item> items;
    for (int frame : sequence::parse_frames(scan.options.frames, scan.options.lenient))
        items.push_back({frame, ""});
    return items;
}

} // namespace tonetool::runs
