// SPDX-License-Identifier: BSD-3-Clause
// What the library runs with.
#pragma once

#include <string>
#include <vector>

#include "tonetool/export.h"

namespace tonetool {

/// "OpenImageIO 2.4.7.1", then OpenColorIO, OpenEXR, and the instruction set that the kernels use
/// on this machine, "instruction set AVX2".
TONETOOL_API std::vector<std::string> library_versions();

} // namespace tonetool
