// SPDX-License-Identifier: BSD-3-Clause
#include "runs/frames.h"

#include <algorithm>
#include <map>
#include <set>

#include "runs/check_end.h"
#include "runs/frame_scan.h"
#include "runs/uncompared.h"
#include "text/error.h"
#include "text/token.h"

namespace tonetool::runs {

namespace {

using sequence::Files;

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
    bool unmatched = listing.names.empty() && (pattern.is_output || !scan.plan.line.compat);
    if (inherits && unmatched) {
        listing.items = first.items;
        listing.names = sequence::file_names(word, scan.options, first.items);
    }
    return listing;
}

void check_length(const Scan& scan, const Pattern& pattern, size_t frames, size_t expected) {
    if (frames != expected) {
        throw CommandError(
            "Not all sequence specifications matched: " + scan.texts()[scan.patterns.front().at] +
            " (" + std::to_string(expected) + " frames) vs. " + scan.texts()[pattern.at] + " (" +
            std::to_string(frames) + " frames)");
    }
}

// The sequences that are read.
std::vector<sequence::Side> sides_of(const Scan& scan) {
    std::vector<sequence::Side> sides;
    for (const Pattern& pattern : scan.patterns) {
        if (scan.plan.check.is_input(pattern.at)) {
            sides.push_back({scan.texts()[pattern.at],
                             sequence::list_files(scan.texts()[pattern.at], scan.options)});
            sequence::check_numbers(sides.back().pattern, sides.back().files, scan.options);
        }
    }
    return sides;
}

// What the frames of a check are, whatever is on the disk.
void pair_frames(Scan& scan, const Files& numbered, std::vector<Files>& listings) {
    FramePlan& plan = scan.plan;
    check_view_names(scan);
    const std::vector<sequence::Side> sides = sides_of(scan);
    check_range_is_used(scan, sides);
    check_views_are_used(scan, sides);
    sequence::Pairing pairs{numbered.items, {}, {}};
    if (!sides.empty()) {
        pairs = sequence::pair_sides(sides, scan.options);
        add_missing_views(pairs, sides, scan.options);
        if (const std::string unseen = sequence::left_out(sides); !unseen.empty())
            plan.warnings.push_back(unseen);
    } else if (pairs.items.empty() && !scan.options.frames.empty()) {
        pairs.items = frames_given(scan); // for outputs alone
    }
    if (pairs.items.empty() && !scan.patterns.empty())
        throw CommandError("no file matches \"" + scan.texts()[scan.patterns.front().at] + "\"");
    size_t side = 0;
    for (const Pattern& pattern : scan.patterns) {
        Files listing{pairs.items, {}};
        if (plan.check.is_input(pattern.at)) {
            listing.from_disk = sides[side].files.from_disk;
            listing.names = pairs.names[side++];
            plan.sequences.push_back(pattern.at);
        } else if (sequence::has_range(scan.texts()[pattern.at])) { // by position
            listing.names = sequence::list_files(scan.texts()[pattern.at], scan.options).names;
            check_length(scan, pattern, listing.names.size(), pairs.items.size());
        } else {
            listing.names =
                sequence::file_names(scan.texts()[pattern.at], scan.options, pairs.items);
        }
        listings.push_back(std::move(listing));
    }
    scan.tests = sides.size() > 1 ? pairs.own[1] : std::vector<sequence::Item>{};
}

void list_frames(Scan& scan, Files& first, std::vector<Files>& listings) {
    if (scan.plan.check.compares && !scan.for_images)
        sequence::check_same_numbers(sides_of(scan));
    for (const Pattern& pattern : scan.patterns) {
        const std::string& word = scan.texts()[pattern.at];
        listings.push_back(listing_of(scan, pattern, word, first));
        const bool told = !scan.plan.named && !scan.plan.line.compat && !scan.for_images;
        const std::string lacking = told && scan.plan.check.is_input(pattern.at)
                                        ? sequence::gaps({word, listings.back()})
                                        : "";
        if (!lacking.empty())
            scan.plan.warnings.push_back(lacking);
        first = listings.front();
        if (first.names.empty() && !scan.plan.line.compat) {
            throw CommandError("no file matches \"" + scan.texts()[pattern.at] +
                               "\" (a word that is no pattern goes after --wildcardoff)");
        }
        check_length(scan, pattern, listings.back().names.size(), first.names.size());
    }
}

void make_runs(Scan& scan, const Files& first, const std::vector<Files>& listings) {
    FramePlan& plan = scan.plan;
    Frame frame{0, scan.options.padding, "", true, scan.same, {}, {}};
    for (size_t p = 0; p < listings.size(); ++p) {
        frame.varying.push_back(scan.patterns[p].at);
        if (listings[p].from_disk && !plan.line.compat)
            frame.found.push_back(scan.patterns[p].at);
    }
    plan.loops = !scan.patterns.empty() || !first.items.empty();
    plan.runs.resize(plan.loops ? first.items.size() : 1);
    for (size_t i = 0; i < plan.runs.size(); ++i) {
        FrameRun& run = plan.runs[i];
        run.words = scan.texts();
        for (size_t p = 0; p < listings.size(); ++p)
            run.words[scan.patterns[p].at] = listings[p].names[i];
        if (plan.loops) {
            run.frame = frame;
            run.frame.number = first.items[i].frame;
            run.frame.view = first.items[i].view;
            run.frame.name = first.items[i].name;
            run.frame.method = first.items[i].method;
        }
        if (!scan.tests.empty())
            run.test_frame = scan.tests[i].frame;
        if (!scan.absent.empty())
            run.absent = scan.absent[i];
    }
}

// A part of a family has fewer frames, never more.
void check_family(const std::string& value, size_t frames) {
    const auto count = parse_integer(value);
    if (count && *count > 0 && size_t(*count) < frames) {
        throw CommandError("biascheck: frames=" + value + ", but there are " +
                           std::to_string(frames) +
                           " frames (valid: family, or the number of all " + "frames of the shot)");
    }
}

// "frames=family" says how many tests there are: those of all frames. As a number it is the same in
// the tasks of a farm, in a check that goes on, and in its results.
void count_families(FramePlan& plan) {
    const auto counted = [&](std::string& text) {
        const Token token = parse_token(text, true);
        for (const auto& [key, value] : token.modifiers)
            if (key == "frames") {
                check_family(value, plan.runs.size());
                if (value == "family")
                    text = token.with_value(key, std::to_string(plan.runs.size()));
            }
    };
    for (const chain::Word& word : plan.line.words) {
        if (!word.is("biascheck"))
            continue;
        for (FrameRun& run : plan.runs)
            counted(run.words.at(word.at));
        const auto& at = plan.check.essence_at;
        const auto found = std::find(at.begin(), at.end(), word.at);
        if (found != at.end())
            counted(plan.check.essence.at(size_t(found - at.begin())));
    }
}

// What a name needs so that two frames differ in it.
std::string wildcards_that_tell(const sequence::Item& a, const sequence::Item& b) {
    if (!a.named())
        return "# or {FRAME_NUMBER}";
    return a.name != b.name ? "%N" : a.method != b.method ? "%M" : a.view != b.view ? "%V" : "#";
}

// Each frame would be written over the one before. What an expression or an --if makes of it is
// seen when it is written.
void check_outputs_differ(const FramePlan& plan) {
    for (size_t at : plan.check.always_written) {
        std::map<std::string, Frame> frames;
        for (const FrameRun& run : plan.runs) {
            const std::string& name = run.words[at];
            const Frame& first = frames.emplace(name, run.frame).first->second;
            const bool same = first.item() == run.frame.item();
            if (!same && name.find('{') == std::string::npos) {
                throw CommandError(
                    "\"" + name + "\" would be written by every " +
                    (first.item().named() ? "case" : "frame") + " over the one before (valid: " +
                    wildcards_that_tell(first.item(), run.frame.item()) + " in the name)");
            }
        }
    }
}

// Leaves out what --only does not name.
void choose_cases(FramePlan& plan) {
    const Strings& only = plan.check.only;
    if (only.empty())
        return;
    if (!plan.named) {
        throw CommandError("--only " + only.front() +
                           " chooses named cases, and the line has none (valid: %N in the names "
                           "of the images, or --frames)");
    }
    const size_t all = plan.runs.size();
    std::vector<bool> chosen(all);
    std::set<std::string> names;
    for (const FrameRun& run : plan.runs)
        names.insert(run.frame.name);
    for (const std::string& text : only) {
        sequence::CaseGlob glob(text);
        glob.look_at(names);
        bool any = false;
        for (size_t i = 0; i < all; ++i)
            if (glob.fits(plan.runs[i].frame.name))
                chosen[i] = any = true;
        if (!any) {
            const std::string meant = sequence::meant_case(text, {names.begin(), names.end()});
            throw CommandError("--only " + text + " names none of the " + std::to_string(all) +
                               " cases" + (meant.empty() ? "" : ", " + meant));
        }
    }
    std::vector<FrameRun> runs;
    for (size_t i = 0; i < all; ++i)
        if (chosen[i])
            runs.push_back(std::move(plan.runs[i]));
    plan.cases = runs.size() < all ? all : 0;
    plan.runs = std::move(runs);
}

// What the rows of the suite say of its cases.
void plan_suite(FramePlan& plan) {
    if (!plan.suite)
        return;
    std::vector<sequence::Item> cases;
    for (const FrameRun& run : plan.runs)
        cases.push_back(run.frame.item());
    plan.suite->check_rows(cases);
    for (FrameRun& run : plan.runs)
        run.of_suite = plan.suite->plan_case(run.frame.item(), run.words, plan.options);
    const Strings title = plan.suite->title();
    plan.check.essence.insert(plan.check.essence.begin(), title.begin(), title.end());
}

// --suite beside --merge: all cases must be in some part.
void expect_cases(FramePlan& plan) {
    Strings words;
    for (const chain::Word& word : plan.line.words)
        if (word.is("suite") || word.is("key") || word.is("only"))
            for (size_t at = word.at; at < word.end(); ++at)
                words.push_back(plan.line.texts[at]);
    const FramePlan all = plan_frames(chain::parse_line(words));
    for (const FrameRun& run : all.runs)
        plan.check.expected.push_back(run.frame.item());
    plan.check.expected_check = all.check.essence;
    plan.suite = all.suite;
    plan.cases = all.cases;
}

} // namespace

void set_for_line(chain::Session& session, const FramePlan& plan) {
    session.settings.compat = plan.line.compat;
    session.settings.details = plan.verbose;
    session.settings.quiet = plan.quiet;
    session.judges = plan.check.judges();
}

FramePlan plan_frames(chain::ParsedLine line, const std::string& directory, bool for_images) {
    const bool merges = std::any_of(line.words.begin(), line.words.end(), [](const auto& word) {
        return word.is("merge") || word.is("merge-list");
    });
    const auto suite = merges ? nullptr : suite_of(line);
    if (suite)
        line = suite->line();
    Scan scan = scan_line(std::move(line), for_images);
    scan.directory = directory;
    scan.plan.check = plan_check(scan.plan.line);
    scan.plan.suite = suite;
    scan.options.lenient = scan.plan.line.compat && !scan.plan.check.judges();
    if (scan.plan.check.has("merge")) {
        if (scan.plan.check.has("suite"))
            expect_cases(scan.plan);
        return scan.plan;
    }
    if (!for_images)
        refuse_uncompared(scan.plan.line, scan.plan.check);
    Files first;
    if (!scan.options.frames.empty() && scan.patterns.empty())
        first.items = frames_given(scan);
    std::vector<Files> listings;
    if (settle_names(scan)) {
        scan.plan.named = true;
        pair_named_cases(scan, listings);
        first = listings.front();
    } else if (scan.plan.check.pairs_frames() && !for_images) {
        pair_frames(scan, first, listings);
        first = listings.empty() ? first : listings.front();
    } else {
        list_frames(scan, first, listings);
    }
    make_runs(scan, first, listings);
    count_families(scan.plan);
    check_outputs_differ(scan.plan);
    scan.plan.options = scan.options;
    plan_suite(scan.plan);
    choose_cases(scan.plan);
    return scan.plan;
}

} // namespace tonetool::runs
