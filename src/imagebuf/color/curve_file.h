// SPDX-License-Identifier: BSD-3-Clause
// Tone curves from files of any kind.
#pragma once

#include <string>

#include "tonemap/table_curve.h"
#include "tonetool/tonemap.h"

namespace tonetool {

/// Whether the name of a curve is that of a file: it has a '.' or a '/'.
bool is_curve_file(const std::string& name);

/// The table that options.name holds, checked; a Refusal names the file, the line and the value.
tonemap::MeasuredRows read_curve_file(const CurveOptions& options);

} // namespace tonetool
