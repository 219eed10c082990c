#include "tonemap/wls.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "kernels/curve_constants.h"

namespace tonetool::tonemap {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Eigen::Lower;
using Eigen::VectorXd;

constexpr double kEpsilon = 1e-4;     // keeps the weights of equal neighbours finite
constexpr int kElementsOfPixel = 3;   // of the lower triangle
constexpr double kCgTolerance = 1e-6; // of the residual's norm, in each round
constexpr int kRounds = 5;

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

    const Matrix& lower() const { return m_lower; }
    const VectorXd& data() const { return m_data; }

    VectorXd residual(const VectorXd& u) const {
        return m_data - m_lower.selfadjointView<Lower>() * u;
    }

    // The largest residual, in tolerances; NaN where there is one.
    double worst(const VectorXd& u, const VectorXd& residual) const {
        double most = 0;
        for (Eigen::Index i = 0; i < u.size(); ++i) {
            const double scale = m_terms.logarithmic ? 1 : u[i];
            const double here = std::abs(residual[i]) / (kWlsTolerance * scale);
            if (!(here >= 0))
                return std::numeric_limits<double>::quiet_NaN();
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
        VectorXd diagonal = VectorXd::Ones(count);
        m_lower.resize(count, count);
        m_lower.reserve(kElementsOfPixel * count);
        for (int y = 0; y < m_height; ++y)
            for (int x = 0; x < m_width; ++x) {
                const int i = unknown(x, y);
                if (i < 0)
                    continue;
                const int right = x + 1 < m_width ? unknown(x + 1, y) : -1;
                const int below = y + 1 < m_height ? unknown(x, y + 1) : -1;
                const double a = weight(i, right), b = weight(i, below);
                m_lower.startVec(i);
                m_lower.insertBack(i, i) = diagonal[i] + a + b;
                add(i, right, a, diagonal);
                add(i, below, b, diagonal);
            }
        m_lower.finalize();
    }

    int unknown(int x, int y) const { return m_unknown[size_t(y) * size_t(m_width) + size_t(x)]; }

    double weight(int i, int j) const {
        if (j < 0)
            return 0;
        return m_terms.lambda / (std::pow(std::abs(m_log[i] - m_log[j]), m_terms.alpha) + kEpsilon);
    }

    void add(int i, int j, double weight, VectorXd& diagonal) {
        if (j < 0)
            return;
        m_lower.insertBack(j, i) = -weight;
        diagonal[j] += weight;
    }

    WlsTerms m_terms;
    int m_width, m_height;
    std::vector<int> m_unknown; // of each pixel; -1: takes no part
    VectorXd m_log, m_data;
    Matrix m_lower;
};

[[noreturn]] void give_up(const std::string& why) {
    throw std::runtime_error("weighted least squares: " + why);
}

// Solves for what the equations lack until they hold.
template <class Solver>
VectorXd solve(const Equations& equations, Solver& solver) {
    VectorXd u = equations.data(), residual = equations.residual(u);
    double worst = equations.worst(u, residual);
    if (worst > 1) {
        solver.compute(equations.lower());
        if (solver.info() != Eigen::Success)
            give_up("the matrix has no factors in double precision");
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

VectorXd solve_iteratively(const Equations& equations, int iterations) {
    using Preconditioner = Eigen::IncompleteCholesky<double, Lower, Eigen::NaturalOrdering<int>>;
    Eigen::ConjugateGradient<Matrix, Lower, Preconditioner> solver;
    solver.setTolerance(kCgTolerance);
    solver.setMaxIterations(iterations);
    return solve(equations, solver);
}

VectorXd solve_directly(const Equations& equations) {
    Eigen::SimplicialLDLT<Matrix, Lower> solver;
    return solve(equations, solver);
}

} // namespace

void wls_base(const WlsTerms& terms, const float* luminance, int width, int height, float* base,
              const WlsMethod& method) {
    const int64_t pixels = int64_t(width) * height;
    if (pixels > std::numeric_limits<int>::max() / kElementsOfPixel)
        give_up("an image of " + std::to_string(pixels) + " pixels is too large");
    const Equations equations(terms, luminance, width, height);
    const bool direct = method.solver == WlsSolver::Direct ||
                        (method.solver == WlsSolver::BySize && pixels <= kDirectPixels);
    const VectorXd u =
        direct ? solve_directly(equations) : solve_iteratively(equations, method.iterations);
    equations.store(u, base);
}

} // namespace tonetool::tonemap
