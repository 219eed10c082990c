// SPDX-License-Identifier: BSD-3-Clause
// From the light of the frames of a shot to the luminances that each of them is exposed by.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tonetool/shot_numbers.h"

namespace tonetool::tonemap {

inline constexpr int kThumbnailWidth = 32, kThumbnailHeight = 18;
inline constexpr int kLightBins = 64;

/// The logarithms of the means of the cells of a plane of luminance without padding; what is not
/// finite or negative is 0. Cells are at least a pixel wide.
std::vector<double> thumbnail_of(const float* plane, int width, int height);
/// The least and the largest that they can be.
std::pair<double, double> thumbnail_range();
/// Of the values above 0; NaN and what stands for black pixels are not counted.
std::vector<int64_t> light_histogram(const float* plane, int64_t pixels);

/// The largest correlation of two thumbnails over shifts of up to two cells. Of two that are both
/// without any contrast it is 1, of one that is 0.
double likeness(const std::vector<double>& a, const std::vector<double>& b);
/// Neighbours that are less alike are of two scenes: of one shot they were .84 and more, a lamp
/// switched off .86, while pairs of different scenes were .36 at most.
inline constexpr double kAlike = 0.6;

/// The luminance that this percentile of counted pixels does not exceed, from a histogram; 0: it is
/// empty.
double percentile_of(const std::vector<int64_t>& histogram, double percentile);

/// One number of a shot, all its views together.
struct ShotFrame {
    int number = 0;
    double lwa = 0, lwa_geometric = 0, lmax = 0; ///< lwa 0: it is black
    double white = 0;                            ///< of the percentile that is asked for, or 0
    double unit = 0, fps = 0;
    int64_t counted = 0;
    const FrameLight* light = nullptr; ///< of the first view
    std::vector<int64_t> histogram;
};

/// Frames by number; each light is that of one view. White is the luminance of `white_percentile`,
/// 100: the maximum.
std::vector<ShotFrame> frames_of(const std::vector<FrameLight>& lights,
                                 std::optional<double> white_percentile);

/// The places of the first frames of scenes, beginning with 0. Black frames are not compared: they
/// belong to the scene before.
std::vector<size_t> find_cuts(const std::vector<ShotFrame>& frames);

/// How exposures follow the light.
struct AdaptTerms {
    std::string mode = "shot"; ///< "shot", "eye", "smooth"
    std::optional<double> tau; ///< in seconds
    double fps = 24;
    std::optional<double> unit; ///< of all frames
    bool linear = false;
};

/// Krawczyk et al. (2005), Eq. 6 and 7: rods of 0.4 s and cones of 0.1 s, by the share of rods at
/// an adaptation luminance in cd/m2.
double eye_time(double luminance);

/// The luminances that frame `at` of a scene is exposed by. Black frames have no light to adapt to:
/// the others decide. All are 0 if the whole scene is black.
ShotFrame adapted(const std::vector<ShotFrame>& scene, size_t at, const AdaptTerms& terms);

/// The numbers that a scene lacks, by the smallest step between its own: "4, 7-9"; empty: none.
std::string lacking(const std::vector<ShotFrame>& scene);

} // namespace tonetool::tonemap
