// SPDX-License-Identifier: BSD-3-Clause
// %N and %M: the runs of a line whose cases have names.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <set>

#include "runs/frame_scan.h"
#include "runs/uncompared.h"
#include "sequence/frames/named_files.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

using sequence::Files;
using sequence::Item;

constexpr char kNothingApproved[] = "no approved image";

bool has_number(const std::string& word) {
    return sequence::NamePattern(sequence::without_range(word)).has_number();
}

// What holds for the numbers of a shot.
void refuse_words_of_shots(const Scan& scan, const std::vector<sequence::Side>& sides) {
    const CheckPlan& check = scan.plan.check;
    if (check.exposures == "shot") {
        throw CommandError("exposures=shot is of the frames of one shot, and %N names many cases "
                           "(valid: no exposures=, so that each case has its own, or a line for "
                           "each shot)");
    }
    if (check.has("bad-frames")) {
        throw CommandError("--bad-frames writes numbers of frames, and %N names cases (valid: "
                           "--json, --csv or --junit)");
    }
    const bool numbered = std::any_of(sides.begin(), sides.end(), [](const sequence::Side& side) {
        return has_number(side.pattern);
    });
    if (!scan.options.frames.empty() && !numbered) {
        throw CommandError("--frames " + scan.options.frames +
                           ": no image that is read has # in its name (valid: # in the name, or "
                           "no --frames)");
    }
}

std::vector<sequence::Side> named_sides(const Scan& scan) {
    std::vector<sequence::Side> sides;
    for (const Pattern& pattern : scan.patterns) {
        const std::string& word = scan.texts()[pattern.at];
        if (!scan.plan.check.is_input(pattern.at))
            continue;
        if (scan.plan.suite && scan.plan.suite->has_store() &&
            pattern.at == scan.plan.suite->reference_at())
            sides.push_back({word, scan.plan.suite->approved_files(), kNothingApproved});
        else
            sides.push_back({word, sequence::list_named(word, scan.options)});
        sequence::check_numbers(word, sides.back().files, scan.options);
    }
    return sides;
}

size_t count_names(const std::vector<Item>& items) {
    std::set<std::string> names;
    for (const Item& item : items)
        names.insert(item.name);
    return names.size();
}

// One reference may be meant for all tests; one test for all references would be counted again and
// again.
void settle_constants(Scan& scan, size_t names) {
    const Reading reading = reading_of(scan.plan.line, scan.plan.check);
    const auto has_name = [&](size_t at) {
        return scan.texts()[at].find("%N") != std::string::npos;
    };
    const auto meant = [&](size_t at) {
        return std::find(scan.same.begin(), scan.same.end(), at) != scan.same.end();
    };
    const bool named = std::any_of(reading.references.begin(), reading.references.end(), has_name);
    for (const size_t at : reading.tests) {
        if (named && !has_name(at) && !meant(at)) {
            throw CommandError("the test has no %N: one image would be checked " +
                               std::to_string(names) + (names == 1 ? " time" : " times"));
        }
    }
    for (const size_t at : reading.references)
        if (!sequence::has_names(scan.texts()[at]))
            scan.same.push_back(at);
}

// Nothing in a name that was found is an expression.
bool has_braces(const std::vector<Item>& items) {
    return std::any_of(items.begin(), items.end(), [](const Item& item) {
        return (item.name + item.method).find('{') != std::string::npos;
    });
}

} // namespace

bool settle_names(Scan& scan) {
    auto& patterns = scan.patterns;
    const auto named = [&](const Pattern& pattern) {
        return scan.plan.check.is_input(pattern.at) &&
               sequence::has_names(scan.texts()[pattern.at]);
    };
    if (scan.options.names && std::any_of(patterns.begin(), patterns.end(), named))
        return true;
    scan.options.names = false;
    const auto plain = [&](const Pattern& pattern) {
        return !sequence::is_pattern(scan.texts()[pattern.at]);
    };
    patterns.erase(std::remove_if(patterns.begin(), patterns.end(), plain), patterns.end());
    return false;
}

void pair_named_cases(Scan& scan, std::vector<Files>& listings) {
    check_view_names(scan);
    const std::vector<sequence::Side> sides = named_sides(scan);
    refuse_words_of_shots(scan, sides);
    check_views_are_used(scan, sides);
    const sequence::Pairing pairs = sequence::pair_named(sides, scan.options);
    settle_constants(scan, count_names(pairs.items));
    scan.absent = pairs.absent;
    size_t side = 0;
    for (const Pattern& pattern : scan.patterns) {
        Files listing{pairs.items, {}};
        if (scan.plan.check.is_input(pattern.at)) {
            listing.from_disk = true;
            listing.names = pairs.names[side++];
            scan.plan.sequences.push_back(pattern.at);
        } else {
            listing.from_disk = has_braces(pairs.items);
            listing.names =
                sequence::file_names(scan.texts()[pattern.at], scan.options, pairs.items);
            for (std::string& name : listing.names)
                if (pattern.is_output && name.compare(0, 1, "-") == 0)
                    name.insert(0, "./"); // else it would be a command
        }
        listings.push_back(std::move(listing));
    }
}

} // namespace tonetool::runs
