// A summary as metadata.
#pragma once

#include <OpenImageIO/imagebuf.h>

#include "include/tonetool/flip.h"

namespace tonetool {

/// Writes the summary as `FLIP:*` attributes: OpenImageIO 3.2's names (meanerror, maxerror, maxx,
/// maxy, startExposure, stopExposure, numExposures) and more of the same kind.
void annotate(OIIO::ImageSpec& spec, const FlipSummary& summary);

} // namespace tonetool
