// SPDX-License-Identifier: BSD-3-Clause
// How texts call a layer. Header only: the command language and checks of sequences use it, too.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "imagebuf/pixels/names.h"

namespace tonetool {

/// The channels R, G and B that no layer's name stands before.
inline constexpr const char* kPlainLayer = "R,G,B";

/// The layer's name, or what stands for an empty one.
inline std::string shown_layer(const std::string& name) {
    return name.empty() ? kPlainLayer : name;
}

/// "did you mean "ViewLayer.Combined"? " of a word that nearly is one of the names, or the last
/// part of one; else empty.
inline std::string meant_layer(const std::string& word, const std::vector<std::string>& names) {
    constexpr size_t least = 3; // any letter is near any other
    std::vector<std::string> ends;
    for (const std::string& name : names)
        ends.push_back(name.substr(name.find_last_of('.') + 1));
    for (const std::vector<std::string>& written : {names, ends}) {
        if (word.size() < least)
            break;
        const std::vector<std::string> near = nearest_names(word, written, 1);
        if (near.empty())
            continue;
        const auto at = std::find(written.begin(), written.end(), near.front()) - written.begin();
        return "did you mean \"" + names[size_t(at)] + "\"? ";
    }
    return "";
}

} // namespace tonetool
