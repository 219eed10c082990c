// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/qc/qc_thumbnails.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tonetool::sequence {

namespace {

// Cells that are this many stops below the median of the shot count as black: noise dominates them.
constexpr double kFloorStops = 8;
// An image with less variation has no structure to compare.
constexpr double kFlat = 1e-3;

double mean(const Thumbnail& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

} // namespace

std::vector<Thumbnail> thumbnails_of(const std::vector<QcFrame*>& frames) {
    constexpr size_t cells = size_t(QcPicture::kWide) * QcPicture::kHigh;
    std::vector<double> lit;
    lit.reserve(frames.size() * cells); // of ten thousand frames
    for (const QcFrame* frame : frames) {
        for (int cell : frame->facts.picture.thumbnail)
            if (cell > QcPicture::kDark)
                lit.push_back(cell / 1000.0);
    }
    const double floor = median(std::move(lit)) - kFloorStops;
    std::vector<Thumbnail> thumbnails;
    for (const QcFrame* frame : frames) {
        Thumbnail& thumbnail = thumbnails.emplace_back();
        thumbnail.reserve(cells);
        for (int cell : frame->facts.picture.thumbnail)
            thumbnail.push_back(std::max(cell / 1000.0, floor) - floor);
    }
    return thumbnails;
}

double distance(const Thumbnail& a, const Thumbnail& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += std::abs(a[i] - b[i]);
    return sum / double(a.size());
}

double gain(const Thumbnail& a, const Thumbnail& b) {
    std::vector<double> steps;
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i] > 0 && b[i] > 0)
            steps.push_back(b[i] - a[i]);
    return median(std::move(steps));
}

double correlation(const Thumbnail& a, const Thumbnail& b) {
    const double mean_a = mean(a), mean_b = mean(b);
    double aa = 0, bb = 0, ab = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    const double flat = kFlat * kFlat * double(a.size());
    if (aa < flat && bb < flat)
        return 1;
    return aa < flat || bb < flat ? 0 : ab / std::sqrt(aa * bb);
}

double usual_step_of(const std::vector<Thumbnail>& thumbnails) {
    std::vector<double> steps;
    for (size_t i = 1; i < thumbnails.size(); ++i)
        steps.push_back(distance(thumbnails[i - 1], thumbnails[i]));
    return median(std::move(steps));
}

bool is_cut(const Thumbnail& a, const Thumbnail& b, double usual_step) {
    constexpr double unlike = 0.8, times = 3;
    return correlation(a, b) < unlike && distance(a, b) > times * usual_step;
}

} // namespace tonetool::sequence
