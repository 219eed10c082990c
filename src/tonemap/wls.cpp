// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/wls.h"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "kernels/curve_constants.h"
#include "tonemap/aggregates.h"

namespace tonetool::tonemap {
namespace {

using Eigen::VectorXd;

constexpr double kEpsilon = 1e-4; // keeps the weights of equal neighbours finite
constexpr int kElementsOfPixel = 5;
constexpr double kCgTolerance = 1e-5; // of the residual's norm, in each round
constexpr int kRounds = 10;

// (1 + lambda L) u = g, over the pixels that take part.
class Equations {
public:
    Equations(const WlsTerms& terms, const float* luminance, int width, int height)
        : m_terms(terms),
          m_width(width),
          m_height(height) {
        number(luminance);
        couple();
    }

    const Aggregates::Matrix& matrix() const { return m_matrix; }
    const VectorXd& data() const { return m_data; }

    VectorXd residual(const VectorXd& u) const { return m_data - m_matrix * u; }

    // The largest residual, in tolerances; NaN where there is one.
    double worst(const VectorXd& u, const VectorXd& residual) const {
        double most = 0;
        for (Eigen::Index i = 0; i < u.size(); ++i) {
            // On the way u may be below 0.
            const double scale = m_terms.logarithmic ? 1 : std::max(u[i], 0.0);
            const double here = std::abs(residual[i]) / (kWlsTolerance * scale);
            if (std::isnan(here))
                return here;
            most = std::max(most, here);
        }
        return most;
    }

    void store(const VectorXd& u, float* base) const {
        for (size_t p = 0; p < m_unknown.size(); ++p)
            base[p] =
                m_unknown[p] < 0 ? std::numeric_limits<float>::quiet_NaN() : float(u[m_unknown[p]]);
    }

private:
    void number(const float* luminance) {
        m_unknown.resize(size_t(m_width) * size_t(m_height));
        int count = 0;
        for (size_t p = 0; p < m_unknown.size(); ++p) {
            const bool lit = luminance[p] >= kernels::kSmallestLuminance &&
                             luminance[p] <= std::numeric_limits<float>::max();
            m_unknown[p] = lit ? count++ : -1;
        }
        m_log.resize(count);
        m_data.resize(count);
        for (size_t p = 0; p < m_unknown.size(); ++p)
            if (const int i = m_unknown[p]; i >= 0) {
                m_log[i] = std::log(double(luminance[p]));
                m_data[i] = m_terms.logarithmic ? m_log[i] : double(luminance[p]);
            }
    }

    void couple() {
        const Eigen::Index count = m_data.size();
        m_matrix.resize(count, count);
        m_matrix.reserve(kElementsOfPixel * count);
        for (int y = 0; y < m_height; ++y)
            for (int x = 0; x < m_width; ++x)
                if (const int i = unknown(x, y); i >= 0)
                    add(i, {unknown(x, y - 1), unknown(x - 1, y), i, unknown(x + 1, y),
                            unknown(x, y + 1)});
        m_matrix.finalize();
    }

    // -1 for pixels outside, too.
    int unknown(int x, int y) const {
        const bool inside = x >= 0 && y >= 0 && x < m_width && y < m_height;
        return inside ? m_unknown[size_t(y) * size_t(m_width) + size_t(x)] : -1;
    }

    // The column of an unknown; its neighbours and itself are in order.
    void add(int i, const std::array<int, kElementsOfPixel>& near) {
        std::array<double, kElementsOfPixel> value{};
        double diagonal = 1;
        for (size_t k = 0; k < near.size(); ++k)
            if (near[k] >= 0 && near[k] != i) {
                value[k] = -weight(i, near[k]);
                diagonal -= value[k];
            }
        m_matrix.startVec(i);
        for (size_t k = 0; k < near.size(); ++k)
            if (near[k] >= 0)
                m_matrix.insertBack(near[k], i) = near[k] == i ? diagonal : value[k];
    }

    double weight(int i, int j) const {
        return m_terms.lambda / (std::pow(std::abs(m_log[i] - m_log[j]), m_terms.alpha) + kEpsilon);
    }

    WlsTerms m_terms;
    int m_width, m_height;
    std::vector<int> m_unknown; // of each pixel; -1: takes no part
    VectorXd m_log, m_data;
    Aggregates::Matrix m_matrix;
};

[[noreturn]] void give_up(const std::string& why) {
    throw std::runtime_error("weighted least squares: " + why);
}

// Solves for the residual and adds the correction, until the equations hold.
VectorXd solve(const Equations& equations, const WlsMethod& method) {
    Eigen::ConjugateGradient<Aggregates::Matrix, Eigen::Lower | Eigen::Upper, Aggregates> solver;
    solver.setTolerance(kCgTolerance);
    solver.setMaxIterations(method.iterations);
    VectorXd u = equations.data(), residual = equations.residual(u);
    double worst = equations.worst(u, residual);
    if (worst > 1) {
        solver.preconditioner().build(equations.matrix(), method.direct);
        solver.compute(equations.matrix());
    }
    for (int round = 0; round < kRounds && worst > 1; ++round) {
        u += solver.solve(residual);
        residual = equations.residual(u);
        worst = equations.worst(u, residual);
    }
    if (!(worst <= 1)) {
        std::ostringstream why;
        why << "not converged, the equations hold to " << worst * kWlsTolerance << ", not to "
            << kWlsTolerance;
        give_up(why.str());
    }
    return u;
}

} // namespace

void wls_base(const WlsTerms& terms, const float* luminance, int width, int height, float* base,
              const WlsMethod& method) {
    const int64_t pixels = int64_t(width) * height;
    if (pixels > std::numeric_limits<int>::max() / kElementsOfPixel)
        give_up("an image of " + std::to_string(pixels) + " pixels is too large");
    const Equations equations(terms, luminance, width, height);
    equations.store(solve(equations, method), base);
}

} // namespace tonetool::tonemap
