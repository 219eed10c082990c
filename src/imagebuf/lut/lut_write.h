// SPDX-License-Identifier: BSD-3-Clause
// Look-up tables as the text of files. Only lut*.cpp include this.
#pragma once

#include <string>
#include <vector>

#include "imagebuf/lut/lut_ops.h"

namespace tonetool {

/// What files say of themselves, a line each.
struct LutRemarks {
    std::string title, input, output;
    std::string shaper; ///< a formula of x; empty: the file takes the input itself
    std::string note;   ///< empty: none
    std::string taken() const { return shaper.empty() ? input : input + ", x, as " + shaper; }
};

bool holds_scene_light(const std::string& format); ///< clf, ctf
/// A Refusal where the format cannot hold such steps.
void check_format(const std::string& format, const LutSource& source);
std::string lut_text(const std::string& format, const LutSteps& steps, const LutRemarks& remarks);

} // namespace tonetool
