// SPDX-License-Identifier: BSD-3-Clause
// Temporary files left behind by writers that were killed.
#pragma once

#include <string>

namespace tonetool {

/// Removes what killed writers of any file have left in the folder of this one, the first time that
/// this process writes there.
void remove_abandoned_once(const std::string& filename);

} // namespace tonetool
