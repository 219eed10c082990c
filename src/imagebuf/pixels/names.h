// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for misspelt names. Header only: the command language uses it,
// too, which sees no symbol of the library but the installed ones.
#pragma once

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace tonetool {

using OIIO::Strutil::lower;

/// How many characters must be changed, added or left out (Levenshtein). OIIO::Strutil's function
/// of this name gives too little: 4 from "ba" to "bbbabaa".
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

/// Whether two neighbours have changed places, the most frequent slip of fingers, and nothing else.
inline bool are_swapped(const std::string& a, const std::string& b) {
    const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    return a.size() == b.size() && a.end() - in_a >= 2 && in_a[0] == in_b[1] &&
           in_a[1] == in_b[0] && std::equal(in_a + 2, a.end(), in_b + 2);
}

/// Those of `names` that a person could have meant by `word`, nearest first, at most `limit`.
inline std::vector<std::string>
nearest_names(const std::string& word, const std::vector<std::string>& names, size_t limit = 3) {
    std::vector<std::pair<size_t, std::string>> ranked;
    for (const std::string& name : names) {
        const bool prefix = word.size() >= 2 && name.compare(0, word.size(), word) == 0;
        const bool swapped = are_swapped(lower(word), lower(name));
        const size_t distance = swapped  ? 0 // before all others
                                : prefix ? 1
                                         : edit_distance(lower(word), lower(name));
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

/// `unknown WHAT "name"; did you mean "x"? valid: ...`.
inline std::string unknown_name(const std::string& what, const std::string& name,
                                const std::vector<std::string>& names) {
    std::string text = "unknown " + what + " \"" + name + "\"; ";
    const auto nearest = nearest_names(name, names, 1);
    if (!nearest.empty())
        text += "did you mean \"" + nearest.front() + "\"? ";
    text += names.empty() ? "there are none" : "valid: ";
    for (size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : ", ") + names[i];
    return text;
}

} // namespace tonetool
