// SPDX-License-Identifier: BSD-3-Clause
// How far a table is from what it was made of. Only lut*.cpp include this.
#pragma once

#include "imagebuf/lut/lut_ops.h"

namespace tonetool {

/// Fills in the errors: of greys, of colours in every cell of a lattice, of its faces and edges,
/// where one or two channels are 0.
void measure_lut(const LutSource& source, const LutShaper& shaper, const LutSteps& steps,
                 LutSummary& summary);

} // namespace tonetool
