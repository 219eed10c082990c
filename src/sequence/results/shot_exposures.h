// The exposures of a shot: measured frame by frame, gathered, kept in files.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// What one frame's reference adds to the range of its shot.
struct ExposureSample {
    int frame = 0;
    std::string view;
    double max_luminance = 0;
    double median_luminance = 0; ///< as HDR-FLIP takes it: of the lit pixels if most are black
    std::string reference{};     ///< the file
};

using ExposureSamples = std::vector<ExposureSample>;

/// Of the samples by frame: the maximum of the maxima and the median of the medians (of an even
/// number the upper one) of the frames that are not black. A runtime_error where there is none.
ShotExposures shot_exposures(const ExposureSamples& samples);

/// The range as a text that tells it from any other.
std::string exposures_text(const ShotExposures& range);

/// The text of an exposure file: the range (absent where all is black) and the samples by number.
std::string to_json(ExposureSamples samples);
/// Its samples; a runtime_error as in results_json.h.
ExposureSamples samples_from_json(const std::string& text);

/// The range that an exposure file, or the --json of a check, holds. A runtime_error names the
/// file.
ShotExposures read_exposures(const std::string& file);

/// Whether the range was measured on that file, among others. Files that keep no names are taken
/// at their word.
bool was_measured_on(const ShotExposures& range, const std::string& file);

/// The whole of a file; a runtime_error where that cannot be read.
std::string read_text(const std::string& file);

} // namespace tonetool::sequence
