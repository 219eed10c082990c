// What a person could have meant by a misspelt name. Header only: both sides of the library's
// border use it, and no symbol of the library is hidden on one side or installed for the other.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace tonetool::text {

/// How many characters must be changed, added or left out (Levenshtein).
inline size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({change, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

/// Those of `names` that a person could have meant by `word`, nearest first, at most `limit`.
inline std::vector<std::string>
nearest_names(const std::string& word, const std::vector<std::string>& names, size_t limit = 3) {
    std::vector<std::pair<size_t, std::string>> ranked;
    for (const std::string& name : names) {
        const bool prefix = word.size() >= 2 && name.compare(0, word.size(), word) == 0;
        const size_t distance = prefix ? 1 : edit_distance(word, name);
        if (prefix || distance <= std::max<size_t>(1, word.size() / 3))
            ranked.emplace_back(distance, name);
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> nearest;
    for (size_t i = 0; i < std::min(limit, ranked.size()); ++i)
        nearest.push_back(ranked[i].second);
    return nearest;
}

} // namespace tonetool::text
