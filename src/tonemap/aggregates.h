// SPDX-License-Identifier: BSD-3-Clause
// A multigrid preconditioner for the conjugate gradients of Eigen.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

namespace tonetool::tonemap {

/// A V-cycle over levels of aggregates: neighbours that are strongly coupled become one unknown,
/// over and over, until few enough are left for a factorisation. For symmetric matrices, both
/// triangles stored, with positive diagonals and no positive element beside them. P. Vanek, J.
/// Mandel, M. Brezina: "Algebraic Multigrid by Smoothed Aggregation" (1996).
class Aggregates {
public:
    using Matrix = Eigen::SparseMatrix<double>;
    using Vector = Eigen::VectorXd;

    /// Refers to `matrix` from then on. So many unknowns as `direct` are solved directly.
    void build(const Matrix& matrix, int direct);

    /// Eigen calls this with a copy of the matrix; there is nothing left to do.
    template <class Any>
    Aggregates& compute(const Any&) {
        return *this;
    }
    Vector solve(const Vector& right) const { return cycle(0, right); }
    Eigen::ComputationInfo info() const { return Eigen::Success; }

private:
    struct Level {
        Matrix coupled; ///< of this level; the first level's is m_matrix
        Matrix members; ///< from the unknowns of the next level to its own; of the last none
    };

    const Matrix& matrix(size_t level) const {
        return level == 0 ? *m_matrix : m_levels[level].coupled;
    }
    Vector cycle(size_t level, const Vector& right) const;

    const Matrix* m_matrix = nullptr;
    std::vector<Level> m_levels;
    Eigen::SimplicialLDLT<Matrix> m_coarsest;
};

} // namespace tonetool::tonemap
