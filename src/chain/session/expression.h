// SPDX-License-Identifier: BSD-3-Clause
// "{TOP.width/2}": values of images, variables and the frame, put into words.
#pragma once

#include <string>

#include "chain/session/session.h"

namespace tonetool::chain {

/// The most that a word may be with the values in it.
inline constexpr size_t kMostBytesOfAWord = 1 << 20;

/// The word with each {...} replaced by its value. What is not understood is a CommandError; with
/// --compat it is reported and the text stays.
std::string with_values(Session& session, const std::string& word);

} // namespace tonetool::chain
