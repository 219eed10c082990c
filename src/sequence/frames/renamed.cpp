// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/renamed.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>

#include "imagebuf/pixels/names.h"

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;

constexpr size_t kMostPairs = 100000, kMostRead = 64; // a hint is not worth more

// What tells a file from others: its size, and a hash of its bytes where another has that size.
struct Contents {
    uintmax_t size = 0;
    uint64_t hash = 0;
    bool known = false;
    bool operator==(const Contents& o) const {
        return known && o.known && size == o.size && hash == o.hash;
    }
};

Contents contents_of(const std::string& file, const std::set<uintmax_t>& sizes) {
    constexpr uintmax_t most = uintmax_t(1) << 28;
    std::error_code why;
    Contents contents;
    contents.size = fs::file_size(file, why);
    std::string bytes;
    if (why || contents.size > most || sizes.count(contents.size) == 0 ||
        !OIIO::Filesystem::read_text_file(file, bytes))
        return contents;
    contents.hash = OIIO::Strutil::strhash(bytes);
    contents.known = true;
    return contents;
}

std::set<uintmax_t> sizes_of(const std::vector<std::string>& names, const std::vector<size_t>& of) {
    std::set<uintmax_t> sizes;
    for (const size_t i : of) {
        std::error_code why;
        const uintmax_t size = fs::file_size(names[i], why);
        if (!why)
            sizes.insert(size);
    }
    return sizes;
}

bool is_near(const std::string& a, const std::string& b) {
    constexpr size_t most = 2;
    const size_t longer = std::max(a.size(), b.size());
    return longer - std::min(a.size(), b.size()) <= most && edit_distance(a, b) <= most;
}

} // namespace

std::vector<std::string> renamed_hints(const Pairing& pairs, const std::vector<bool>& no_reference,
                                       const std::vector<bool>& no_test) {
    std::vector<std::string> hints(pairs.items.size());
    std::vector<size_t> lost, extra;
    for (size_t i = 0; i < hints.size(); ++i)
        if (no_reference[i] != no_test[i])
            (no_test[i] ? lost : extra).push_back(i);
    if (lost.size() * extra.size() > kMostPairs)
        return hints;
    const auto join = [&](const auto& belong) {
        for (const size_t a : lost)
            for (const size_t b : extra)
                if (hints[a].empty() && hints[b].empty() && belong(a, b)) {
                    hints[a] = ", renamed? \"" + pairs.items[b].name + "\" is there";
                    hints[b] = ", renamed? \"" + pairs.items[a].name + "\" is there";
                }
    };
    if (lost.size() + extra.size() <= kMostRead) {
        const std::vector<std::string>&references = pairs.names[0], &tests = pairs.names[1];
        const std::set<uintmax_t> sizes = sizes_of(references, lost),
                                  others = sizes_of(tests, extra);
        std::map<size_t, Contents> contents;
        for (const size_t i : lost)
            contents[i] = contents_of(references[i], others);
        for (const size_t i : extra)
            contents[i] = contents_of(tests[i], sizes);
        join([&](size_t a, size_t b) { return contents[a] == contents[b]; });
    }
    join([&](size_t a, size_t b) {
        return pairs.items[a].method == pairs.items[b].method &&
               is_near(pairs.items[a].name, pairs.items[b].name);
    });
    return hints;
}

} // namespace tonetool::sequence
