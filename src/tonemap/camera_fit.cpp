// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/camera_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tonetool::tonemap {
namespace {

constexpr int64_t kMostPoints = 4000;
constexpr size_t kFewestPoints = 24; // each gives two rows for eleven unknowns
// Share of the extent that the scene must have as depth: less is the rounding of half floats.
constexpr double kLeastDepth = 1e-3;
constexpr double kWithin = 0.99;

using Matrix = Eigen::Matrix<double, 12, 12>;

struct Point {
    float at[3];
    double x, y; ///< where it is seen, in pixels
};

bool is_surface(const SeenPositions& seen, int64_t i) {
    return !(seen.background && seen.background[i]) && std::isfinite(seen.plane[0][i]) &&
           std::isfinite(seen.plane[1][i]) && std::isfinite(seen.plane[2][i]);
}

std::vector<Point> points_of(const SeenPositions& seen) {
    const int64_t pixels = int64_t(seen.width) * seen.height;
    int64_t count = 0;
    for (int64_t i = 0; i < pixels; ++i)
        count += is_surface(seen, i) ? 1 : 0;
    const int64_t step = std::max<int64_t>(1, (count + kMostPoints - 1) / kMostPoints);
    std::vector<Point> points;
    int64_t place = 0;
    for (int64_t i = 0; i < pixels; ++i)
        if (is_surface(seen, i) && place++ % step == 0)
            points.push_back({{seen.plane[0][i], seen.plane[1][i], seen.plane[2][i]},
                              double(i % seen.width) + 0.5,
                              double(i / seen.width) + 0.5});
    return points;
}

// What brings points to a mean of 0 and a deviation of 1.
struct Scaling {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    double deviation = 0;
    bool flat = false;

    explicit Scaling(const std::vector<Point>& points) {
        for (const Point& p : points)
            mean += vector_of(p);
        mean /= double(points.size());
        Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
        for (const Point& p : points) {
            const Eigen::Vector3d from = vector_of(p) - mean;
            moments += from * from.transpose();
        }
        deviation = std::sqrt(moments.trace() / (3 * double(points.size())));
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments, Eigen::EigenvaluesOnly);
        const Eigen::Vector3d extents = axes.eigenvalues(); // from the smallest
        flat = !(extents[0] > kLeastDepth * kLeastDepth * extents[2]);
    }

    static Eigen::Vector3d vector_of(const Point& p) {
        return {double(p.at[0]), double(p.at[1]), double(p.at[2])};
    }
    Eigen::Vector4d scaled(const Point& p) const {
        return ((vector_of(p) - mean) / deviation).homogeneous();
    }
};

Projection solve(const std::vector<Point>& points, const Scaling& scaling,
                 const SeenPositions& seen) {
    Matrix sums = Matrix::Zero();
    for (const Point& p : points) {
        const Eigen::Vector4d q = scaling.scaled(p);
        const double u = (p.x - 0.5 * seen.width) / seen.width;
        const double v = (p.y - 0.5 * seen.height) / seen.width;
        Eigen::Matrix<double, 2, 12> rows;
        rows << q.transpose(), Eigen::RowVector4d::Zero(), -u * q.transpose(),
            Eigen::RowVector4d::Zero(), q.transpose(), -v * q.transpose();
        sums += rows.transpose() * rows;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix> vectors(sums);
    const Eigen::Matrix<double, 12, 1> smallest = vectors.eigenvectors().col(0);
    // Of points as they are.
    Eigen::Matrix<double, 3, 4> rows;
    for (int r = 0; r < 3; ++r) {
        rows.row(r) = smallest.segment<4>(4 * r).transpose();
        rows.row(r).head<3>() /= scaling.deviation;
        rows(r, 3) -= rows.row(r).head<3>().dot(scaling.mean);
    }
    double in_front = 0;
    for (const Point& p : points)
        in_front += rows.row(2).dot(Scaling::vector_of(p).homogeneous()) > 0 ? 1 : -1;
    rows *= (in_front < 0 ? -1 : 1) / rows.norm();
    Projection camera;
    for (size_t i = 0; i < camera.size(); ++i)
        camera[i] = rows(Eigen::Index(i) / 4, Eigen::Index(i) % 4);
    return camera;
}

double residual_of(const Projection& camera, const std::vector<Point>& points,
                   const SeenPositions& seen) {
    std::vector<double> away;
    for (const Point& p : points) {
        double x = 0, y = 0;
        const bool found = project(camera, p.at, seen.width, seen.height, x, y);
        const double off = std::hypot(x - p.x, y - p.y);
        away.push_back(found && std::isfinite(off) ? off : std::numeric_limits<double>::infinity());
    }
    const auto at = away.begin() + std::ptrdiff_t(kWithin * double(away.size() - 1));
    std::nth_element(away.begin(), at, away.end());
    return *at;
}

} // namespace

CameraFit fit_camera(const SeenPositions& seen) {
    CameraFit fit;
    const std::vector<Point> points = points_of(seen);
    if (points.size() < kFewestPoints)
        return fit;
    const Scaling scaling(points);
    fit.lack = NoCamera::Flat;
    if (scaling.flat)
        return fit;
    const Projection camera = solve(points, scaling, seen);
    fit.residual = residual_of(camera, points, seen);
    fit.lack = fit.residual <= kMostResidual ? NoCamera::None : NoCamera::Inexact;
    if (fit.lack == NoCamera::None)
        fit.camera = camera;
    return fit;
}

} // namespace tonetool::tonemap
