// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/aggregates.h"

#include <cmath>

namespace tonetool::tonemap {
namespace {

using Matrix = Aggregates::Matrix;
using Vector = Aggregates::Vector;

// Constants of P. Vanek et al.: the threshold of a strong coupling on the first level, which is
// halved from level to level, and the smoothing of members for a matrix whose spectrum ends at 2.
constexpr double kStrong = 0.08, kSmoothing = 2.0 / 3;

// The matrix without weak couplings. They are added to the diagonal, so that row sums stay.
Matrix strong_part(const Matrix& a, double strong) {
    const Vector diagonal = a.diagonal();
    Matrix out(a.rows(), a.cols());
    out.reserve(a.nonZeros());
    for (int i = 0; i < int(a.cols()); ++i) {
        const auto weak = [&](const Matrix::InnerIterator& it) {
            return it.row() != i &&
                   -it.value() < strong * std::sqrt(diagonal[i] * diagonal[it.row()]);
        };
        double own = 0;
        for (Matrix::InnerIterator it(a, i); it; ++it)
            if (it.row() == i || weak(it))
                own += it.value();
        out.startVec(i);
        for (Matrix::InnerIterator it(a, i); it; ++it)
            if (!weak(it))
                out.insertBack(it.row(), i) = it.row() == i ? own : it.value();
    }
    out.finalize();
    return out;
}

// The aggregate of each unknown, of two at least; -1: none, it has no strong neighbours. First
// those of a whole neighbourhood; whoever is left has a neighbour in one of them.
class Grouping {
public:
    explicit Grouping(const Matrix& strong) : m_strong(strong), m_group(size_t(strong.cols()), -1) {
        for (int i = 0; i < int(strong.cols()); ++i)
            if (m_group[size_t(i)] < 0 && has_neighbours(i) && all_free(i))
                found(i);
        const std::vector<int> first = m_group;
        for (int i = 0; i < int(strong.cols()); ++i)
            if (m_group[size_t(i)] < 0)
                join(i, first);
    }

    Matrix members() const {
        std::vector<Eigen::Triplet<double>> ones;
        ones.reserve(m_group.size());
        for (size_t i = 0; i < m_group.size(); ++i)
            if (m_group[i] >= 0)
                ones.emplace_back(int(i), m_group[i], 1.0);
        Matrix out(Eigen::Index(m_group.size()), m_count);
        out.setFromTriplets(ones.begin(), ones.end());
        return out;
    }

private:
    bool has_neighbours(int i) const { return m_strong.col(i).nonZeros() > 1; }

    bool all_free(int i) const {
        for (Matrix::InnerIterator it(m_strong, i); it; ++it)
            if (m_group[size_t(it.row())] >= 0)
                return false;
        return true;
    }

    void found(int i) {
        for (Matrix::InnerIterator it(m_strong, i); it; ++it)
            if (m_group[size_t(it.row())] < 0)
                m_group[size_t(it.row())] = m_count;
        ++m_count;
    }

    void join(int i, const std::vector<int>& groups) {
        double strongest = 0;
        for (Matrix::InnerIterator it(m_strong, i); it; ++it)
            if (groups[size_t(it.row())] >= 0 && -it.value() > strongest) {
                strongest = -it.value();
                m_group[size_t(i)] = groups[size_t(it.row())];
            }
    }

    const Matrix& m_strong;
    std::vector<int> m_group;
    int m_count = 0;
};

Matrix smoothed(const Matrix& strong, const Matrix& members) {
    const Vector scale = kSmoothing * strong.diagonal().cwiseInverse();
    const Matrix step = scale.asDiagonal() * strong;
    return members - Matrix(step * members);
}

Matrix coupled(const Matrix& a, const Matrix& members) {
    const Matrix half = a * members;
    return Matrix(members.transpose()) * half;
}

} // namespace

void Aggregates::build(const Matrix& first, int direct) {
    m_matrix = &first;
    m_levels.assign(1, {});
    double strong = kStrong;
    while (matrix(m_levels.size() - 1).cols() > direct) {
        const Matrix& fine = matrix(m_levels.size() - 1);
        const Matrix kept = strong_part(fine, strong);
        const Matrix members = Grouping(kept).members();
        m_levels.back().members = smoothed(kept, members);
        Level coarse;
        coarse.coupled = coupled(fine, m_levels.back().members);
        m_levels.push_back(coarse);
        strong /= 2;
    }
    if (const Matrix& last = matrix(m_levels.size() - 1); last.cols() > 0)
        m_coarsest.compute(last);
}

Vector Aggregates::cycle(size_t level, const Vector& right) const {
    if (level + 1 == m_levels.size())
        return right.size() > 0 ? Vector(m_coarsest.solve(right)) : right;
    const Matrix& a = matrix(level);
    const Matrix& members = m_levels[level].members;
    Vector x = a.triangularView<Eigen::Lower>().solve(right);
    const Vector coarse = members.transpose() * (right - a * x);
    x += members * cycle(level + 1, coarse);
    x += a.triangularView<Eigen::Upper>().solve(right - a * x);
    return x;
}

} // namespace tonetool::tonemap
