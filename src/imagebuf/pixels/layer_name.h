// SPDX-License-Identifier: BSD-3-Clause
// How texts call a layer. Header only: the command language and checks of sequences use it, too.
#pragma once

#include <string>

namespace tonetool {

/// The channels R, G and B that no layer's name stands before.
inline constexpr const char* kPlainLayer = "R,G,B";

/// The layer's name, or what stands for an empty one.
inline std::string shown_layer(const std::string& name) {
    return name.empty() ? kPlainLayer : name;
}

} // namespace tonetool
