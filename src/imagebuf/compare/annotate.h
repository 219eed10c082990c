// SPDX-License-Identifier: BSD-3-Clause
// A summary as metadata.
#pragma once

#include <OpenImageIO/imagebuf.h>

#include "tonetool/bias.h"
#include "tonetool/errors.h"
#include "tonetool/flip.h"
#include "tonetool/tmqi.h"

namespace tonetool {

/// Writes the summary as `FLIP:*` attributes: OpenImageIO 3.2's names (meanerror, maxerror, maxx,
/// maxy, startExposure, stopExposure, numExposures) and more of the same kind.
void annotate(OIIO::ImageSpec& spec, const FlipSummary& summary);
/// As `Error:*`: metric, value (or decibels), and the rest by the names above.
void annotate(OIIO::ImageSpec& spec, const ErrorSummary& summary);
/// As `TMQI:*`: Q, S, N, S1 to S5, the finest scale first.
void annotate(OIIO::ImageSpec& spec, const TmqiSummary& summary);
/// As `Bias:*`: verdict, reason, sentence, within, alpha, and the names of bias_numbers().
void annotate(OIIO::ImageSpec& spec, const BiasSummary& summary);

} // namespace tonetool
