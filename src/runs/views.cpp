// SPDX-License-Identifier: BSD-3-Clause
// The views of a check: --views, %V and %v.
#include <algorithm>
#include <map>
#include <set>

#include "runs/frame_scan.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

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

} // namespace

void check_view_names(const Scan& scan) {
    const Strings& views = scan.options.views;
    const std::set<std::string> names(views.begin(), views.end());
    if (scan.views && (names.empty() || names.size() != views.size() || names.count("") > 0)) {
        throw CommandError("--views " + *scan.views +
                           ": a view has no name or is there twice (valid: different names with "
                           "commas between them: left,right)");
    }
}

void check_views_are_used(const Scan& scan, const std::vector<sequence::Side>& sides) {
    if (scan.views && std::none_of(sides.begin(), sides.end(), has_view)) {
        throw CommandError("--views " + *scan.views +
                           ": no image that is read has a view in its name (valid: %V or %v in the "
                           "name, or no --views)");
    }
    std::for_each(sides.begin(), sides.end(), check_views_differ);
}

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

} // namespace tonetool::runs
