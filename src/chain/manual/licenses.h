// SPDX-License-Identifier: BSD-3-Clause
// --licenses.
#pragma once

#include "chain/language/registry.h"

namespace tonetool::chain {

/// LICENSE and src/THIRD_PARTY.md, which the build embeds in the program.
extern const char* const kLicenceTexts;

/// The row of --licenses.
Rows licence_commands();

} // namespace tonetool::chain
