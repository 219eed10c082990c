// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/renamed.h"

#include <OpenImageIO/filesystem.h>
#include <algorithm>
#include <filesystem>
#include <numeric>

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;

constexpr size_t kMostPairs = 100000; // a hint is not worth more

bool same_bytes(const std::string& a, const std::string& b) {
    std::error_code why_a, why_b;
    const auto size = fs::file_size(a, why_a);
    if (why_a || fs::file_size(b, why_b) != size || why_b || size > (uintmax_t(1) << 30))
        return false;
    std::string one, other;
    return OIIO::Filesystem::read_text_file(a, one) && OIIO::Filesystem::read_text_file(b, other) &&
           one == other;
}

// Letters to change, add or leave out.
size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t above = row[j + 1];
            row[j + 1] = std::min({above + 1, row[j] + 1, diagonal + (a[i] == b[j] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row.back();
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
    join([&](size_t a, size_t b) { return same_bytes(pairs.names[0][a], pairs.names[1][b]); });
    join([&](size_t a, size_t b) {
        return pairs.items[a].method == pairs.items[b].method &&
               is_near(pairs.items[a].name, pairs.items[b].name);
    });
    return hints;
}

} // namespace tonetool::sequence
