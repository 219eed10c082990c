// SPDX-License-Identifier: BSD-3-Clause
// The exposures of a shot: measured frame by frame, combined, and kept in files.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// The contribution of one frame's reference to the range of its shot.
struct ExposureSample {
    int frame = 0;
    std::string view;
    double max_luminance = 0;
    /// As HDR-FLIP takes it: the median of the non-black pixels if most pixels are black.
    double median_luminance = 0;
    std::string reference{}; ///< the file
};

using ExposureSamples = std::vector<ExposureSample>;

/// Combines the samples of all frames that are not black: the maximum of the maxima and the median
/// of the medians (of an even number the upper one). Throws a runtime_error if all are black.
ShotExposures shot_exposures(const ExposureSamples& samples);

/// The range as a text that differs from that of any other range.
std::string exposures_text(const ShotExposures& range);

/// The text of an exposure file: the range (absent if all frames are black) and the samples by
/// number.
std::string to_json(ExposureSamples samples);
/// Reads its samples; throws a runtime_error as in results_json.h.
ExposureSamples samples_from_json(const std::string& text);

/// The range in an exposure file or in the --json of a check. Throws a runtime_error that names the
/// file.
ShotExposures read_exposures(const std::string& file);

/// Whether that file is among those that the range was measured on. True for exposure files that
/// keep no names.
bool was_measured_on(const ShotExposures& range, const std::string& file);

/// The whole content of a file; throws a runtime_error if it cannot be read.
std::string read_text(const std::string& file);

} // namespace tonetool::sequence
