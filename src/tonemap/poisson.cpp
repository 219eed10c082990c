// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/poisson.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <utility>

namespace tonetool::tonemap {
namespace {

using kernels::Offset;

// SplitMix64 (G. Steele, D. Lea, C. Flood 2014): integers alone.
class Random {
public:
    explicit Random(uint64_t seed) : m_state(seed * 0x632be59bd9b4e019u) {}
    /// In [0, n), n much less than 2^32.
    int64_t below(int64_t n) {
        m_state += 0x9e3779b97f4a7c15u;
        uint64_t z = (m_state ^ (m_state >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
        return int64_t((z >> 32) * uint64_t(n) >> 32);
    }

private:
    uint64_t m_state;
};

constexpr int32_t kOne = 256; // a share of 1

// Root of the wanted density at each place of the window. No place is taken twice: where so many
// offsets are wanted that it would have to be, the density is cut off.
class Density {
public:
    Density(int half, int count) : m_side(2 * half + 1) {
        const int64_t q = std::max(int64_t(half) * half, int64_t(1));
        for (int dy = -half; dy <= half; ++dy)
            for (int dx = -half; dx <= half; ++dx)
                m_roots.push_back(int32_t(kOne * q / (q + 8 * (dx * dx + dy * dy))));
        while (m_most > 1 && places(m_most) < count)
            --m_most;
        for (int32_t& root : m_roots)
            root = std::clamp(root, 1, m_most);
        int64_t sum = 0;
        for (int32_t root : m_roots)
            m_sums.push_back(sum += int64_t(root) * root);
    }

    int side() const { return m_side; }
    const std::vector<int32_t>& roots() const { return m_roots; }
    double at(int place) const {
        const double share = double(m_roots[size_t(place)]) / m_most;
        return share * share;
    }
    int draw(Random& random) const {
        const int64_t at = random.below(m_sums.back());
        return int(std::upper_bound(m_sums.begin(), m_sums.end(), at) - m_sums.begin());
    }

private:
    // How many offsets there are if places of this root are taken once.
    int64_t places(int32_t most) const {
        int64_t sum = 0;
        for (int32_t root : m_roots)
            sum += int64_t(std::min(root, most)) * std::min(root, most);
        return sum / (int64_t(most) * most);
    }

    int m_side;
    int32_t m_most = kOne;
    std::vector<int32_t> m_roots;
    std::vector<int64_t> m_sums;
};

// How far the nearest offset is from each place: squared, in the unit of the density there. No more
// than half^2 times 2^13: roots are small where distances are not.
class Distances {
public:
    explicit Distances(const Density& density)
        : m_density(density),
          m_squares(density.roots().size(), INT32_MAX) {}

    int32_t operator[](int place) const { return m_squares[size_t(place)]; }

    void take(int place) {
        const int side = m_density.side(), x0 = place % side, y0 = place / side;
        const int32_t root = m_density.roots()[size_t(place)];
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const auto i = size_t(y * side + x);
                const int32_t square = (x - x0) * (x - x0) + (y - y0) * (y - y0);
                m_squares[i] = std::min(m_squares[i], square * root * m_density.roots()[i]);
            }
    }

private:
    const Density& m_density;
    std::vector<int32_t> m_squares;
};

int best_candidate(const Density& density, const Distances& distances, Random& random,
                   int candidates) {
    int best = density.draw(random);
    for (int i = 1; i < candidates; ++i)
        if (const int other = density.draw(random); distances[other] > distances[best])
            best = other;
    // All taken: the first that is free.
    for (int place = 0; distances[best] == 0; ++place)
        best = place;
    return best;
}

std::vector<Offset> make_set(int half, int count, const Density& density, unsigned seed) {
    constexpr int kCandidatesEach = 1, kLeastCandidates = 16;
    Distances distances(density);
    Random random(seed + 1u);
    std::vector<Offset> out;
    int place = (density.side() * density.side()) / 2;
    while (true) {
        out.push_back(
            {place % density.side() - half, place / density.side() - half, density.at(place)});
        if (int(out.size()) == count)
            return out;
        distances.take(place);
        place = best_candidate(density, distances, random,
                               kLeastCandidates + kCandidatesEach * int(out.size()));
    }
}

// At least the centre, at most every position of the window.
int possible(int half, int count) {
    return std::clamp(count, 1, (2 * half + 1) * (2 * half + 1));
}

} // namespace

std::vector<Offset> poisson_set(int half, int count, unsigned seed) {
    count = possible(half, count);
    return make_set(half, count, Density(half, count), seed);
}

std::vector<std::vector<Offset>> poisson_sets(int half, int count) {
    static std::mutex lock;
    static std::pair<int, int> last;
    static std::vector<std::vector<Offset>> kept;
    count = possible(half, count);
    const std::lock_guard<std::mutex> hold(lock);
    if (last == std::pair(half, count) && !kept.empty())
        return kept;
    const Density density(half, count);
    kept.clear();
    for (int i = 0; i < kPoissonSets; ++i)
        kept.push_back(make_set(half, count, density, unsigned(i)));
    last = {half, count};
    return kept;
}

} // namespace tonetool::tonemap
