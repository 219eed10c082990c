#include "runs/frames.h"

#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <unistd.h>

#include "chain/session/call.h"
#include "sequence/frames/file_sequence.h"
#include "sequence/frames/pairing.h"
#include "text/error.h"
#include "text/printable.h"
#include "text/token.h"

namespace tonetool::runs {

namespace {

using sequence::Files;

// Words with wildcards, by their place on the command line.
struct Pattern {
    size_t at;
    bool is_output;
};

struct Scan {
    FramePlan plan;
    std::string directory{};
    sequence::PatternOptions options;
    std::optional<std::string> views; ///< of --views, as it was given
    std::vector<Pattern> patterns;
    bool for_images = false;
    std::vector<sequence::Item> tests; ///< of the second sequence, where they are others
    std::vector<size_t> same; ///< words that --wildcardoff says to be the same in all frames
};

bool is_output(const std::string& name) {
    const chain::Command* row = chain::find_command(name);
    return row && row->group == chain::Group::Write && row->writes();
}

// The settings that hold for the whole command line; true if `name` was one with an argument.
bool take_setting(Scan& scan, const std::string& name, const std::string& argument) {
    if (name == "frames") {
        if (!scan.options.frames.empty() && !scan.plan.compat) {
            throw CommandError("--frames is given twice: " + scan.options.frames + " and " +
                               argument + " (valid: once, as " + scan.options.frames + "," +
                               argument + ")");
        }
        scan.options.frames = argument;
    } else if (name == "framepadding") {
        scan.options.padding = checked_integer("DIGITS", argument, {1, 9});
    } else if (name == "views") {
        scan.views = argument;
        scan.options.views = split(argument, ',');
    } else if (name == "parallel-frames" || name == "jobs") {
        scan.plan.parallel = checked_integer("N", argument, {1, 1024});
    } else {
        return false;
    }
    return true;
}

Scan scan_words(const Strings& words) {
    Scan scan;
    scan.plan.compat = is_compat(words);
    bool wildcards = true, output = false, all = false;
    const std::vector<bool> command = commands_among(words);
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        std::string name = command[i] ? word.substr(word[1] == '-' ? 2 : 1) : std::string();
        wildcards = name == "wildcardon" || (wildcards && name != "wildcardoff");
        scan.plan.skip_bad |= name == "skip-bad-frames";
        scan.plan.warnings_exit |= name == "warnings-exit";
        scan.plan.verbose = (name == "v" || scan.plan.verbose) && name != "q";
        scan.plan.progress = name == "progress=json" ? "json" : scan.plan.progress;
        if ((name == "parallel-frames" || name == "jobs") &&
            chain::is_left_out("[N]", words, i + 1)) {
            scan.plan.parallel = int(std::max(1U, OIIO::Sysutil::hardware_concurrency()));
            continue;
        }
        if (i + 1 < words.size() && take_setting(scan, name, words[i + 1])) {
            ++i;
            continue;
        }
        if (wildcards && !all && sequence::is_pattern(word))
            scan.patterns.push_back({i, output});
        else if (!wildcards)
            scan.same.push_back(i);
        output = is_output(name.substr(0, name.find(':')));
        all = output && name.find(":all=") != std::string::npos;
    }
    return scan;
}

// A pattern that names no file may be a text or an output that takes its numbers from the first.
Files listing_of(const Scan& scan, const Pattern& pattern, const std::string& word,
                 const Files& first) {
    bool inherits = &pattern != scan.patterns.data();
    Files listing;
    const bool here = scan.directory.empty() || word.front() == '/' || word.front() == '-';
    const std::string prefix = here ? "" : scan.directory + "/";
    if (sequence::is_pattern(prefix))
        throw CommandError("the folder \"" + scan.directory + "\" has wildcards in its name");
    const bool numbered = !scan.options.frames.empty() || sequence::has_range(word);
    if (!(inherits && pattern.is_output && !numbered)) {
        listing = sequence::list_files(prefix + word, scan.options);
        for (std::string& name : listing.names)
            name.erase(0, prefix.size());
    }
    bool unmatched = listing.names.empty() && (pattern.is_output || !scan.plan.compat);
    if (inherits && unmatched) {
        listing.items = first.items;
        listing.names = sequence::file_names(word, scan.options, first.items);
    }
    return listing;
}

void check_length(const Strings& words, const Scan& scan, const Pattern& pattern, size_t frames,
                  size_t expected) {
    if (frames != expected) {
        throw CommandError(
            "Not all sequence specifications matched: " + words[scan.patterns.front().at] + " (" +
            std::to_string(expected) + " frames) vs. " + words[pattern.at] + " (" +
            std::to_string(frames) + " frames)");
    }
}

// The sequences that are read.
std::vector<sequence::Side> sides_of(const Strings& words, const Scan& scan) {
    std::vector<sequence::Side> sides;
    for (const Pattern& pattern : scan.patterns) {
        if (scan.plan.check.is_input(pattern.at)) {
            sides.push_back(
                {words[pattern.at], sequence::list_files(words[pattern.at], scan.options)});
            sequence::check_numbers(sides.back().pattern, sides.back().files, scan.options);
        }
    }
    return sides;
}

// Whether a frame's images may be others than the next one's, though none that is read has a
// wildcard. What is written or printed makes no difference.
bool may_vary(const Strings& words, bool also_by_wildcard) {
    const auto varies = [also_by_wildcard](const std::string& word) {
        return word.find("FRAME_NUMBER") != std::string::npos ||
               (also_by_wildcard && sequence::is_pattern(word));
    };
    for (const LeadWord& lead : lead_words(words)) {
        const chain::Command* row = lead.row;
        if (row &&
            (row->writes() || row->group == chain::Group::Write || row->names.front() == "echo"))
            continue;
        const auto is_written = [row](const std::string& key) {
            return row && std::any_of(row->modifiers.begin(), row->modifiers.end(),
                                      [&](const chain::Modifier& modifier) {
                                          return modifier.key == key && modifier.writes();
                                      });
        };
        for (const auto& [key, text] : parse_token(row ? words[lead.at] : "", true).modifiers)
            if (!is_written(key) && varies(text))
                return true;
        if ((!row && varies(words[lead.at])) ||
            std::any_of(lead.arguments.begin(), lead.arguments.end(),
                        [&](size_t at) { return varies(words[at]); }))
            return true;
    }
    return false;
}

// A range that no name takes would check the same files again and again, or others.
void check_range_is_used(const Strings& words, const Scan& scan,
                         const std::vector<sequence::Side>& sides) {
    const std::vector<size_t>& inputs = scan.plan.check.inputs;
    if (scan.options.frames.empty())
        return;
    if (sides.empty() && !may_vary(words, inputs.empty())) {
        throw CommandError(
            "--frames " + scan.options.frames + ": " +
            (inputs.empty()
                 ? "nothing that makes an image depends on the frame, so all would be "
                   "the same (valid: an image that is read with # in its name, "
                   "{FRAME_NUMBER}, or no --frames)"
                 : "no image that is read has a wildcard, so each frame would be the "
                   "same as \"" +
                       words[inputs.front()] + "\" (valid: # in the name, or no --frames)"));
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

bool has_view(const sequence::Side& side) {
    return sequence::NamePattern(sequence::without_range(side.pattern)).has_view();
}

// Two views of one file would be the same picture twice.
void check_views_differ(const sequence::Side& side) {
    std::map<std::pair<int, std::string>, std::string> views;
    for (size_t i = 0; i < side.files.items.size(); ++i) {
        const sequence::Item& item = side.files.items[i];
        const std::string& name = side.files.names[i];
        const auto first = views.emplace(std::pair(item.frame, name), item.view).first;
        if (first->second != item.view) {
            throw CommandError("\"" + name + "\" is the file of two views, " + first->second +
                               " and " + item.view + " (valid: %V in \"" + side.pattern +
                               "\", for their whole names)");
        }
    }
}

void check_view_names(const Scan& scan) {
    const Strings& views = scan.options.views;
    const std::set<std::string> names(views.begin(), views.end());
    if (scan.views && (names.empty() || names.size() != views.size() || names.count("") > 0)) {
        throw CommandError("--views " + *scan.views +
                           ": a view has no name or is there twice (valid: different names with "
                           "commas between them: left,right)");
    }
}

// Views that no name takes would be checked nowhere.
void check_views_are_used(const Scan& scan, const std::vector<sequence::Side>& sides) {
    if (scan.views && std::none_of(sides.begin(), sides.end(), has_view)) {
        throw CommandError("--views " + *scan.views +
                           ": no image that is read has a view in its name (valid: %V or %v in the "
                           "name, or no --views)");
    }
    std::for_each(sides.begin(), sides.end(), check_views_differ);
}

std::vector<sequence::Item> items_of(const Scan& scan) {
    std::vector<sequence::Item> items;
    for (int frame : sequence::parse_frames(scan.options.frames, scan.options.lenient))
        items.push_back({frame, ""});
    return items;
}

// A view that %V stands for is missing though no file of it is on the disk.
void add_missing_views(sequence::Pairing& pairs, const std::vector<sequence::Side>& sides,
                       const sequence::PatternOptions& options) {
    if (pairs.items.empty() || std::any_of(sides.begin(), sides.end(),
                                           [](const auto& side) { return !side.files.from_disk; }))
        return;
    if (std::none_of(sides.begin(), sides.end(), has_view))
        return;
    sequence::Side all{"", {pairs.items, {}, true}};
    for (const std::string& view : options.views)
        all.files.items.push_back({pairs.items.front().frame, view});
    const std::vector<sequence::Item> items = sequence::paired({all});
    if (items.size() == pairs.items.size())
        return;
    pairs.items = items;
    for (size_t i = 0; i < sides.size(); ++i)
        pairs.names[i] = sequence::names_of(sides[i], options, items);
}

// What the frames of a check are, whatever is on the disk.
void pair_frames(const Strings& words, Scan& scan, const Files& numbered,
                 std::vector<Files>& listings) {
    FramePlan& plan = scan.plan;
    check_view_names(scan);
    const std::vector<sequence::Side> sides = sides_of(words, scan);
    check_range_is_used(words, scan, sides);
    check_views_are_used(scan, sides);
    sequence::Pairing pairs{numbered.items, {}, {}};
    if (!sides.empty()) {
        pairs = sequence::pair_sides(sides, scan.options);
        add_missing_views(pairs, sides, scan.options);
    } else if (pairs.items.empty() && !scan.options.frames.empty()) {
        pairs.items = items_of(scan); // for outputs alone
    }
    if (pairs.items.empty() && !scan.patterns.empty())
        throw CommandError("no file matches \"" + words[scan.patterns.front().at] + "\"");
    size_t side = 0;
    for (const Pattern& pattern : scan.patterns) {
        Files listing{pairs.items, {}};
        if (plan.check.is_input(pattern.at)) {
            listing.from_disk = sides[side].files.from_disk;
            listing.names = pairs.names[side++];
            plan.sequences.push_back(pattern.at);
        } else if (sequence::has_range(words[pattern.at])) { // by position
            listing.names = sequence::list_files(words[pattern.at], scan.options).names;
            check_length(words, scan, pattern, listing.names.size(), pairs.items.size());
        } else {
            listing.names = sequence::file_names(words[pattern.at], scan.options, pairs.items);
        }
        listings.push_back(std::move(listing));
    }
    scan.tests = sides.size() > 1 ? pairs.own[1] : std::vector<sequence::Item>{};
}

void list_frames(const Strings& words, Scan& scan, Files& first, std::vector<Files>& listings) {
    if (scan.plan.check.compares && !scan.for_images)
        sequence::check_same_numbers(sides_of(words, scan));
    for (const Pattern& pattern : scan.patterns) {
        listings.push_back(listing_of(scan, pattern, words[pattern.at], first));
        first = listings.front();
        if (first.names.empty() && !scan.plan.compat) {
            throw CommandError("no file matches \"" + words[pattern.at] +
                               "\" (a word that is no pattern goes after --wildcardoff)");
        }
        check_length(words, scan, pattern, listings.back().names.size(), first.names.size());
    }
}

void make_runs(const Strings& words, Scan& scan, const Files& first,
               const std::vector<Files>& listings) {
    FramePlan& plan = scan.plan;
    Frame frame{0, scan.options.padding, "", true, scan.same, {}, {}};
    for (size_t p = 0; p < listings.size(); ++p) {
        frame.varying.push_back(scan.patterns[p].at);
        if (listings[p].from_disk && !plan.compat)
            frame.found.push_back(scan.patterns[p].at);
    }
    plan.loops = !scan.patterns.empty() || !first.items.empty();
    plan.runs.resize(plan.loops ? first.items.size() : 1);
    for (size_t i = 0; i < plan.runs.size(); ++i) {
        FrameRun& run = plan.runs[i];
        run.words = words;
        for (size_t p = 0; p < listings.size(); ++p)
            run.words[scan.patterns[p].at] = listings[p].names[i];
        if (plan.loops) {
            run.frame = frame;
            run.frame.number = first.items[i].frame;
            run.frame.view = first.items[i].view;
        }
        if (!scan.tests.empty())
            run.test_frame = scan.tests[i].frame;
    }
}

// Each frame would be written over the one before. What an expression or an --if makes of it is
// seen when it is written.
void check_outputs_differ(const FramePlan& plan) {
    for (size_t at : plan.check.always_written) {
        std::map<std::string, Frame> frames;
        for (const FrameRun& run : plan.runs) {
            const std::string& name = run.words[at];
            const Frame& first = frames.emplace(name, run.frame).first->second;
            const bool same = first.number == run.frame.number && first.view == run.frame.view;
            if (!same && name.find('{') == std::string::npos) {
                throw CommandError("\"" + name +
                                   "\" would be written by every frame over the one "
                                   "before (valid: # or {FRAME_NUMBER} in the name)");
            }
        }
    }
}

} // namespace

FramePlan plan_frames(const Strings& words, const std::string& directory, bool for_images) {
    Scan scan = scan_words(words);
    scan.directory = directory;
    scan.for_images = for_images;
    scan.plan.check = plan_check(words, scan.plan.compat);
    scan.options.lenient = scan.plan.compat && !scan.plan.check.judges();
    if (scan.plan.check.has("merge"))
        return scan.plan;
    Files first;
    if (!scan.options.frames.empty() && scan.patterns.empty())
        first.items = items_of(scan);
    std::vector<Files> listings;
    if (scan.plan.check.pairs_frames() && !for_images) {
        pair_frames(words, scan, first, listings);
        first = listings.empty() ? first : listings.front();
    } else {
        list_frames(words, scan, first, listings);
    }
    make_runs(words, scan, first, listings);
    check_outputs_differ(scan.plan);
    return scan.plan;
}

Progress::Progress(std::ostream& stream, const FramePlan& plan)
    : m_stream(stream),
      m_json(plan.progress == "json"),
      m_terminal(!m_json && plan.loops && &stream == &std::cerr && isatty(STDERR_FILENO) == 1),
      m_verbose(!m_json && plan.loops && plan.verbose && !plan.compat),
      m_total(plan.runs.size()) {}

void Progress::done(const FrameRun& run, int status, const std::string& words, double seconds) {
    ++m_done;
    double elapsed = m_time();
    double rate = elapsed > 0 ? double(m_done) / elapsed : 0;
    double left = rate > 0 ? double(m_total - m_done) / rate : 0;
    if (m_json) {
        m_stream << OIIO::Strutil::fmt::format(
                        "{{\"frame\": {}, \"status\": {}, \"done\": {}, \"total\": {}, "
                        "\"frames_per_second\": {:.4g}, \"seconds_left\": {:.1f}}}",
                        run.frame.number, status, m_done, m_total, rate, left)
                 << std::endl;
    } else if (m_verbose) {
        m_stream << OIIO::Strutil::fmt::format("frame {}{}{}: {}, {:.2f} s, {:.0f} s left",
                                               run.frame.number, run.frame.view.empty() ? "" : " ",
                                               printable(run.frame.view), words, seconds, left)
                 << std::endl;
    } else if (m_terminal) {
        // Past the stream, which lets no name go back in its line, and nothing else either.
        const std::string text =
            OIIO::Strutil::fmt::format("\r{} of {} frames, {:.3g} a second, {:.0f} s left {}",
                                       m_done, m_total, rate, left, m_done == m_total ? "\n" : "");
        std::fputs(text.c_str(), stderr);
    }
}

} // namespace tonetool::runs
