// SPDX-License-Identifier: BSD-3-Clause
// Bringing colours of display light within the display.
#pragma once

#include <array>

namespace tonetool::tonemap {

/// What happens to a colour with a channel above 1. In this order the options name them.
enum class Clip {
    Hue,       ///< between Luminance and Neutral, the more saturated it is the more of the latter
    Luminance, ///< its light stays, and so does its hue: it becomes whiter
    Neutral,   ///< its hue and more of its saturation stay: it becomes darker
    Channel    ///< each channel by itself: its hue turns
};

/// Negative channels become 0, then a colour with a channel above 1 is brought to at most 1; grey
/// stays grey. `weights` are those of luminance.
void clip_color(Clip how, const std::array<double, 3>& weights, float (&rgb)[3]);

} // namespace tonetool::tonemap
