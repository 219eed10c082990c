#include "tonemap/poisson.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace tonetool::tonemap {
namespace {

using kernels::Offset;

// SplitMix64 (G. Steele, D. Lea, C. Flood 2014): integers alone.
class Random {
public:
    explicit Random(uint64_t seed) : m_state(seed * 0x632be59bd9b4e019u) {}
    /// In [0, n), n much less than 2^32.
    int below(int n) {
        m_state += 0x9e3779b97f4a7c15u;
        uint64_t z = (m_state ^ (m_state >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
        return int((z >> 32) * uint64_t(n) >> 32);
    }

private:
    uint64_t m_state;
};

// The window as a torus, with each place's squared distance to the nearest offset taken.
class Places {
public:
    explicit Places(int half)
        : m_half(half),
          m_side(2 * half + 1),
          m_squares(size_t(m_side)),
          m_nearest(size_t(m_side) * size_t(m_side), INT32_MAX) {}

    int count() const { return int(m_nearest.size()); }
    int side() const { return m_side; }
    int32_t nearest(int place) const { return m_nearest[size_t(place)]; }
    Offset offset(int place) const { return {place % m_side - m_half, place / m_side - m_half}; }

    void take(int place) {
        const int x0 = place % m_side, y0 = place / m_side;
        for (int x = 0; x < m_side; ++x)
            m_squares[size_t(x)] = square(x - x0);
        for (int y = 0; y < m_side; ++y) {
            int32_t* const row = m_nearest.data() + y * m_side;
            const int32_t down = square(y - y0);
            for (int x = 0; x < m_side; ++x)
                row[x] = std::min(row[x], m_squares[size_t(x)] + down);
        }
    }

private:
    int32_t square(int step) const {
        const int away = std::min(std::abs(step), m_side - std::abs(step));
        return away * away;
    }

    int m_half, m_side;
    std::vector<int32_t> m_squares, m_nearest;
};

int best_candidate(const Places& places, Random& random, int candidates) {
    int best = random.below(places.count());
    for (int i = 1; i < candidates; ++i)
        if (const int other = random.below(places.count());
            places.nearest(other) > places.nearest(best))
            best = other;
    // All taken: the first that is free.
    for (int place = 0; places.nearest(best) == 0 && place < places.count(); ++place)
        best = place;
    return best;
}

} // namespace

std::vector<Offset> poisson_set(int half, int count, unsigned seed) {
    Places places(half);
    Random random(seed + 1u);
    count = std::clamp(count, 1, places.count());
    std::vector<Offset> out;
    for (int place = places.count() / 2; int(out.size()) < count;) {
        out.push_back(places.offset(place));
        places.take(place);
        constexpr int kCandidatesEach = 4, kLeastCandidates = 16;
        if (int(out.size()) < count)
            place = best_candidate(places, random,
                                   kLeastCandidates + kCandidatesEach * int(out.size()));
    }
    return out;
}

std::vector<std::vector<Offset>> poisson_sets(int half, int count, int sets) {
    std::vector<std::vector<Offset>> out;
    for (int i = 0; i < sets; ++i)
        out.push_back(poisson_set(half, count, unsigned(i)));
    return out;
}

} // namespace tonetool::tonemap
