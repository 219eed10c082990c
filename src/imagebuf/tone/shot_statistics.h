// SPDX-License-Identifier: BSD-3-Clause
// The exposure of an image by the shot that it is in.
#pragma once

#include <optional>
#include <string>

#include "tonetool/shot.h"

namespace tonetool {

/// Of Lmax in the statistics of a shot.
inline constexpr double kShotPercentile = 99.99;
/// Thumbnails are kept in thousandths.
inline constexpr double kThumbnailSteps = 1000;

/// The exposure of an image follows from the shot's statistics, not from the image.
inline bool adapts(const AdaptOptions& options) {
    return !options.statistics.frames.empty() || options.adapt != "frame";
}

struct ShotLight {
    ShotExposure exposure;
    double white = 0; ///< 0: no percentile was asked for
    /// The least and the largest unit in the headers of the frames between the cuts; 0: none says.
    double least_unit = 0, largest_unit = 0;
};

/// Refuses what is wrong with the options, the file or the frame.
ShotLight light_of_shot(const AdaptOptions& options, std::optional<double> white_percentile = {});

/// ToneAlgo::steady_window, but that errors are thrown.
std::vector<int> steady_window_of(const AdaptOptions& options);

/// Refuses a unit that nothing needs: not of an image whose `method` needs none, in a shot of this
/// mode or in none.
void check_unit(const AdaptOptions& options, const std::string& mode, const std::string& method);

/// "eye of frames 1 to 8".
std::string shot_words(const ShotExposure& exposure);

/// As the public functions, but that errors are thrown.
std::string text_of_shot(ShotStatistics shot);
ShotStatistics shot_from_text(const std::string& text);
ShotStatistics shot_from_file(const std::string& file);

} // namespace tonetool
