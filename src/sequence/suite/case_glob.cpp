// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/suite/case_glob.h"

#include <algorithm>

#include "imagebuf/pixels/names.h"

namespace tonetool::sequence {

namespace {

// Whether `c` is one of the signs of a glob's [...] that begins at `at`, which ends behind it.
bool in_brackets(const std::string& glob, size_t& at, char c) {
    size_t i = at + 1;
    const bool other = i < glob.size() && glob[i] == '!';
    i += other ? 1 : 0;
    bool found = false;
    for (bool first = true; i < glob.size() && (first || glob[i] != ']'); first = false) {
        const char low = glob[i];
        const bool range = i + 2 < glob.size() && glob[i + 1] == '-' && glob[i + 2] != ']';
        const char high = range ? glob[i + 2] : low;
        const auto byte = [](char sign) { return static_cast<unsigned char>(sign); };
        found = found || (byte(low) <= byte(c) && byte(c) <= byte(high));
        i += range ? 3 : 1;
    }
    at = i + 1;
    return found != other;
}

bool closes_brackets(const std::string& glob, size_t at) {
    const size_t first = at + 1 + (at + 1 < glob.size() && glob[at + 1] == '!' ? 1 : 0);
    return glob.find(']', first + 1) != std::string::npos;
}

} // namespace

std::string meant_case(const std::string& glob, const std::vector<std::string>& names) {
    std::string name = glob.compare(0, 2, "./") == 0 ? glob.substr(2) : glob;
    for (const bool whole : {true, false}) {
        if (!whole) // "gallery.exr"
            name.resize(std::min(name.rfind('.'), name.size()));
        const auto near = nearest_names(name, names, 1);
        if (!near.empty())
            return "did you mean \"" + near.front() + "\"?";
    }
    return "";
}

bool fits_glob(const std::string& glob, const std::string& text) {
    size_t g = 0, t = 0, star = std::string::npos, behind = 0;
    while (t < text.size()) {
        size_t next = g + 1;
        bool fits = false;
        if (g < glob.size() && glob[g] == '*') {
            star = g++;
            behind = t;
            continue;
        }
        if (g < glob.size() && glob[g] == '[' && closes_brackets(glob, g)) {
            next = g;
            fits = in_brackets(glob, next, text[t]);
        } else if (g < glob.size()) {
            fits = glob[g] == '?' || glob[g] == text[t];
        }
        if (fits) {
            g = next;
            ++t;
        } else if (star != std::string::npos) { // the star takes one more
            g = star + 1;
            t = ++behind;
        } else {
            return false;
        }
    }
    while (g < glob.size() && glob[g] == '*')
        ++g;
    return g == glob.size();
}

bool CaseGlob::fits(const std::string& name) const {
    return m_is_name ? name == m_text : fits_glob(m_text, name);
}

bool CaseGlob::is_pattern() const {
    return !m_is_name && m_text.find_first_of("*?[") != std::string::npos;
}

} // namespace tonetool::sequence
