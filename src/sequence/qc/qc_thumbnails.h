// SPDX-License-Identifier: BSD-3-Clause
// Compares images by their thumbnails.
#pragma once

#include <vector>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

/// The luminances of the cells in stops, limited to a floor that is the same for all frames of a
/// shot.
using Thumbnail = std::vector<double>;

std::vector<Thumbnail> thumbnails_of(const std::vector<QcFrame*>& frames);
/// The mean absolute difference in stops.
double distance(const Thumbnail& a, const Thumbnail& b);
/// The stops by which b is brighter: the median over the cells that are above the floor in both.
double gain(const Thumbnail& a, const Thumbnail& b);
/// The median distance between consecutive thumbnails.
double usual_step_of(const std::vector<Thumbnail>& thumbnails);
/// Whether there is a cut between two consecutive thumbnails.
bool is_cut(const Thumbnail& a, const Thumbnail& b, double usual_step);
/// Their correlation, which ignores brightness and contrast, -1 to 1.
double correlation(const Thumbnail& a, const Thumbnail& b);

} // namespace tonetool::sequence
