// Pictures compared by their thumbnails.
#pragma once

#include <vector>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

/// Luminances of the cells in stops, of all frames of a shot above the same floor.
using Thumbnail = std::vector<double>;

std::vector<Thumbnail> thumbnails_of(const std::vector<QcFrame*>& frames);
/// Mean absolute difference in stops.
double distance(const Thumbnail& a, const Thumbnail& b);
/// By how many stops b is brighter: the median over the cells that are above the floor in both.
double gain(const Thumbnail& a, const Thumbnail& b);
/// The median distance of each to the next.
double usual_step_of(const std::vector<Thumbnail>& thumbnails);
/// Whether two that follow each other are different pictures.
bool is_cut(const Thumbnail& a, const Thumbnail& b, double usual_step);
/// How alike they are but for brightness and contrast, -1 to 1.
double correlation(const Thumbnail& a, const Thumbnail& b);

} // namespace tonetool::sequence
