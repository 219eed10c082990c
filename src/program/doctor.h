// SPDX-License-Identifier: BSD-3-Clause
// Whether other programs on this computer read recipes, and if not why.
#pragma once

#include <vector>

#include "chain/language/registry.h"

namespace tonetool {

chain::Rows doctor_commands();

} // namespace tonetool
