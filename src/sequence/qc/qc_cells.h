// SPDX-License-Identifier: BSD-3-Clause
// The cells of a frame's facts as one string: whole numbers of 8 and 16 bits, little-endian, in a
// zlib stream, in base64. A frame takes about 15 kB of it.
#pragma once

#include <string>

#include "tonetool/qc.h"

namespace tonetool::sequence {

/// Of the picture: thumbnail, red, blue, peaks, fingerprints; then the cells of each guide,
/// and which objects there are.
std::string cells_text(const QcFacts& facts);
/// Fills them; the guides and objects already have their layers. Throws a runtime_error if the
/// string is not of such facts.
void read_cells(const std::string& text, QcFacts& facts);

} // namespace tonetool::sequence
