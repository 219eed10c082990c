#include "sequence/pairing.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace tonetool::sequence {

namespace {

constexpr long long most_frames = 1000000;

using Key = std::pair<int, std::string>;

Key key(const Item& item) {
    return {item.frame, item.view};
}

void fill_holes(std::set<Key>& keys) {
    std::set<std::string> views;
    std::set<int> numbers;
    for (const auto& [number, view] : keys) {
        numbers.insert(number);
        views.insert(view);
    }
    long long step = 0, before = *numbers.begin();
    for (long long number : numbers) {
        step = std::gcd(step, number - before);
        before = number;
    }
    const long long first = *numbers.begin(), last = *numbers.rbegin();
    if (step > 0 && (last - first) / step >= most_frames) {
        throw std::runtime_error("frames " + std::to_string(first) + " to " + std::to_string(last) +
                                 " are too many to look for missing ones (valid: --frames)");
    }
    for (long long number = first; step > 0 && number <= last; number += step) {
        for (const std::string& view : views) {
            keys.emplace(int(number), view);
        }
    }
}

} // namespace

std::vector<Item> paired(const std::vector<Side>& sides) {
    std::set<Key> keys;
    bool from_disk = true;
    for (const Side& side : sides) {
        from_disk = from_disk && side.files.from_disk;
        for (const Item& item : side.files.items) {
            keys.insert(key(item));
        }
    }
    if (from_disk && !keys.empty()) {
        fill_holes(keys);
    }
    std::vector<Item> items;
    for (const auto& [number, view] : keys) {
        items.push_back({number, view});
    }
    return items;
}

std::vector<std::string> names_of(const Side& side, const PatternOptions& options,
                                  const std::vector<Item>& items) {
    // What is found on the disk begins with "./" though the pattern does not.
    const bool dotted = side.pattern.compare(0, 2, "./") == 0;
    std::map<Key, std::string> known;
    for (size_t i = 0; i < side.files.items.size(); ++i) {
        const std::string& name = side.files.names.at(i);
        const bool strip = !dotted && name.compare(0, 2, "./") == 0;
        known.emplace(key(side.files.items[i]), strip ? name.substr(2) : name);
    }
    std::vector<std::string> names = file_names(side.pattern, options, items);
    for (size_t i = 0; i < items.size(); ++i) {
        const auto found = known.find(key(items[i]));
        names[i] = found == known.end() ? names[i] : found->second;
    }
    return names;
}

} // namespace tonetool::sequence
