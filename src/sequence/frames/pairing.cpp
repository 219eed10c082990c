// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/pairing.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "sequence/frames/frame_range.h"

namespace tonetool::sequence {

namespace {

std::vector<int> numbers_of(const std::vector<Item>& items) {
    std::set<int> numbers;
    for (const Item& item : items)
        numbers.insert(item.frame);
    return {numbers.begin(), numbers.end()};
}

std::string frames_text(const std::vector<int>& numbers) {
    return (numbers.size() == 1 ? "frame " : "frames ") + range_text(numbers);
}

std::string side_text(const Side& side) {
    return "\"" + side.pattern + "\" has " + frames_text(numbers_of(side.files.items));
}

// "seq/ref.1001-1004#.exr": the pattern with the range of its files.
std::string with_range(const Side& side) {
    const size_t at = side.pattern.find_first_of("#@%");
    return side.pattern.substr(0, at) + range_text(numbers_of(side.files.items)) +
           side.pattern.substr(at);
}

std::vector<int> without(const std::vector<int>& all, const std::vector<int>& some) {
    std::vector<int> rest;
    std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
    return rest;
}

// What makes pairs of two sequences whose numbers differ.
std::string pairs_text(const Side& a, const Side& b) {
    const std::vector<int> of_a = numbers_of(a.files.items), of_b = numbers_of(b.files.items);
    const std::vector<int> lacks = without(of_a, of_b);
    if (of_a.size() != of_b.size() && lacks.size() < of_a.size()) {
        return (lacks.empty() ? "" : ": it lacks " + frames_text(lacks)) +
               " (valid: --frames with numbers that both have)";
    }
    return " (valid: --frames with numbers that both have; or ranges of equal length in the names, "
           "which pair them by position: " +
           with_range(a) + " " + with_range(b) + ")";
}

// The first of the sides with a range: the others are compared with it.
const Side* first_range(const std::vector<Side>& sides) {
    const auto found = std::find_if(sides.begin(), sides.end(),
                                    [](const Side& side) { return !side.files.from_disk; });
    return found == sides.end() ? nullptr : &*found;
}

bool differ_by_range(const std::vector<Side>& sides) {
    const Side* first = first_range(sides);
    return first && std::any_of(sides.begin(), sides.end(), [&](const Side& side) {
               return !side.files.from_disk && !(side.files.items == first->files.items);
           });
}

void check_positions(const std::vector<Side>& sides) {
    const Side& first = sides.front();
    for (const Side& side : sides) {
        if (side.files.from_disk) {
            throw std::runtime_error("\"" + side.pattern +
                                     "\" has no frame range, the other names have different ones "
                                     "(valid: a range in each name)");
        }
        if (side.files.items.size() != first.files.items.size()) {
            throw std::runtime_error(
                "\"" + first.pattern + "\" has " + std::to_string(first.files.items.size()) +
                " frames, \"" + side.pattern + "\" " + std::to_string(side.files.items.size()) +
                " (valid: ranges of equal length, paired by position)");
        }
    }
    std::set<Item> keys;
    for (const Item& item : first.files.items) {
        if (!keys.insert(item).second) {
            throw std::runtime_error("\"" + first.pattern + "\" has frame " +
                                     std::to_string(item.frame) +
                                     " twice (valid: every frame of the first range once)");
        }
    }
}

Pairing by_position(const std::vector<Side>& sides, const PatternOptions& options) {
    check_positions(sides);
    Pairing pairing{sides.front().files.items, {}, {}};
    for (const Side& side : sides) {
        pairing.names.push_back(input_names(side.pattern, options, side.files.items));
        pairing.own.push_back(side.files.items == pairing.items ? std::vector<Item>{}
                                                                : side.files.items);
    }
    return pairing;
}

void check_common_number(const std::vector<Side>& sides) {
    const Side& first = sides.front();
    for (const Side& side : sides) {
        const std::vector<int> a = numbers_of(first.files.items), b = numbers_of(side.files.items);
        std::vector<int> common;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
        if (!a.empty() && !b.empty() && common.empty()) {
            throw std::runtime_error(side_text(first) + ", " + side_text(side) +
                                     ": none has the same number" + pairs_text(first, side));
        }
    }
}

} // namespace

void fill_holes(std::set<Item>& keys) {
    std::set<std::string> views;
    std::set<int> numbers;
    for (const Item& item : keys) {
        numbers.insert(item.frame);
        views.insert(item.view);
    }
    const Item any = *keys.begin();
    long long step = 0, before = *numbers.begin();
    for (long long number : numbers) {
        step = std::gcd(step, number - before);
        before = number;
    }
    step = numbers.size() == 2 ? 1 : step; // two numbers alone do not tell a step
    const long long first = *numbers.begin(), last = *numbers.rbegin();
    if (step > 0 && (last - first) / step >= kMostFrames) {
        throw std::runtime_error("frames " + std::to_string(first) + " to " + std::to_string(last) +
                                 " are too many to look for missing ones (valid: --frames)");
    }
    for (long long number = first; step > 0 && number <= last; number += step)
        for (const std::string& view : views)
            keys.insert({int(number), view, any.name, any.method});
}

std::vector<Item> paired(const std::vector<Side>& sides) {
    std::set<Item> keys;
    bool from_disk = true;
    for (const Side& side : sides) {
        from_disk = from_disk && side.files.from_disk;
        for (const Item& item : side.files.items)
            keys.insert(item);
    }
    if (from_disk && !keys.empty())
        fill_holes(keys);
    return {keys.begin(), keys.end()};
}

Pairing pair_sides(const std::vector<Side>& sides, const PatternOptions& options) {
    if (differ_by_range(sides))
        return by_position(sides, options);
    const Side* range = first_range(sides);
    if (!range)
        check_common_number(sides);
    Pairing pairing{paired(range ? std::vector<Side>{*range} : sides), {}, {}};
    for (const Side& side : sides) {
        pairing.names.push_back(names_of(side, options, pairing.items));
        pairing.own.emplace_back();
    }
    return pairing;
}

std::string left_out(const std::vector<Side>& sides) {
    const Side* range = first_range(sides);
    if (!range)
        return "";
    const std::vector<int> chosen = numbers_of(range->files.items);
    for (const Side& side : sides) {
        const std::vector<int> own = numbers_of(side.files.items);
        const std::vector<int> rest = without(own, chosen);
        if (side.files.from_disk && !rest.empty()) {
            return "\"" + side.pattern + "\" also has " + frames_text(rest) +
                   ", which the range of \"" + range->pattern + "\" leaves out (valid: --frames " +
                   range_text(chosen) + " if that is meant, or no range in the name)";
        }
    }
    return "";
}

std::string gaps(const Side& side) {
    std::set<Item> all(side.files.items.begin(), side.files.items.end());
    const std::vector<int> there = numbers_of(side.files.items);
    if (!side.files.from_disk || there.size() < 3)
        return "";
    try {
        fill_holes(all);
    } catch (const std::runtime_error&) { // far apart
        return "";
    }
    const std::vector<int> whole = numbers_of({all.begin(), all.end()});
    const std::vector<int> lacking = without(whole, there);
    return lacking.empty()
               ? ""
               : "\"" + side.pattern + "\" has no " + frames_text(lacking) + " (valid: --frames " +
                     range_text(there) + " if that is meant, --frames " + range_text(whole) +
                     " where a missing frame is an error)";
}

void check_same_numbers(const std::vector<Side>& sides) {
    for (const Side& side : sides) {
        const Side& first = sides.front();
        const bool ranges = !side.files.from_disk && !first.files.from_disk;
        if (!ranges && !(side.files.items == first.files.items)) {
            throw std::runtime_error(side_text(first) + ", " + side_text(side) +
                                     pairs_text(first, side));
        }
    }
}

std::vector<std::string> names_of(const Side& side, const PatternOptions& options,
                                  const std::vector<Item>& items) {
    // Names found on the disk begin with "./" even where the pattern does not.
    const bool dotted = side.pattern.compare(0, 2, "./") == 0;
    std::map<Item, std::string> known;
    for (size_t i = 0; side.files.from_disk && i < side.files.items.size(); ++i) {
        const std::string& name = side.files.names.at(i);
        const bool strip = !dotted && name.compare(0, 2, "./") == 0;
        known.emplace(side.files.items[i], strip ? name.substr(2) : name);
    }
    std::vector<std::string> names = input_names(side.pattern, options, items);
    for (size_t i = 0; i < items.size(); ++i) {
        const auto found = known.find(items[i]);
        names[i] = found == known.end() ? names[i] : found->second;
    }
    return names;
}

} // namespace tonetool::sequence
