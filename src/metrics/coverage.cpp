// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/coverage.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace tonetool::metrics {
namespace {

uint32_t rotated(uint32_t value, int by) {
    return value << by | value >> (32 - by);
}

uint32_t mixed(uint32_t k) {
    return rotated(k * 0xcc9e2d51u, 15) * 0x1b873593u;
}

// Austin Appleby's MurmurHash3_x86_32, seed 0.
uint32_t murmur3(std::string_view text) {
    const auto byte = [&](size_t i) { return uint32_t(static_cast<unsigned char>(text[i])); };
    uint32_t h = 0;
    size_t at = 0;
    for (; at + 4 <= text.size(); at += 4) {
        h ^= mixed(byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16 | byte(at + 3) << 24);
        h = rotated(h, 13) * 5 + 0xe6546b64u;
    }
    uint32_t tail = 0;
    for (size_t i = text.size(); i > at; --i)
        tail = tail << 8 | byte(i - 1);
    h ^= mixed(tail);
    h ^= uint32_t(text.size());
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

// Adds to the share of an id, of those from `first` on.
void add_share(std::vector<Coverage::Share>& shares, size_t first, uint32_t id, double coverage) {
    const auto found = std::find_if(shares.begin() + ptrdiff_t(first), shares.end(),
                                    [&](const Coverage::Share& share) { return share.id == id; });
    if (found != shares.end())
        found->coverage += coverage;
    else
        shares.push_back({id, coverage});
}

class PairSums {
public:
    PairSums(const Coverage& reference, const Coverage& test, const CoveredPixels& pixels)
        : m_reference(reference),
          m_test(test),
          m_pixels(pixels) {}

    std::vector<CoveragePair> run() {
        for (size_t p = 0; p < m_reference.pixels(); ++p)
            add_pixel(p);
        std::sort(m_pairs.begin(), m_pairs.end(),
                  [](const CoveragePair& a, const CoveragePair& b) { return a.id < b.id; });
        return std::move(m_pairs);
    }

private:
    void add_pixel(size_t p) {
        for (const Coverage::Share* a = m_reference.begin(p); a != m_reference.end(p); ++a)
            add(p, a->id, a->coverage, m_test.of(p, a->id));
        for (const Coverage::Share* b = m_test.begin(p); b != m_test.end(p); ++b)
            if (m_reference.of(p, b->id) == 0)
                add(p, b->id, 0, b->coverage);
    }

    CoveragePair& pair_of(uint32_t id) {
        const auto [found, is_new] = m_places.try_emplace(id, m_pairs.size());
        if (is_new)
            m_pairs.emplace_back().id = id;
        return m_pairs[found->second];
    }

    void add(size_t p, uint32_t id, double a, double b) {
        CoveragePair& pair = pair_of(id);
        const double change = b - a;
        pair.a += a;
        pair.b += b;
        pair.error += (a + b) / 2 * double(m_pixels.error[p]);
        (change > 0 ? pair.gained : pair.lost) += std::abs(change);
        const size_t row = p / m_pixels.width;
        const auto x = double(p - row * m_pixels.width), y = double(row);
        pair.x[0] += a * x;
        pair.x[1] += b * x;
        pair.y[0] += a * y;
        pair.y[1] += b * y;
        if (std::abs(change) >= CoveragePair::kChange)
            pair.changes.emplace_back(p, std::abs(change));
        add_light(pair, p, std::min(a, b));
    }

    void add_light(CoveragePair& pair, size_t p, double both) const {
        const float *r = m_pixels.reference + 3 * p, *t = m_pixels.test + 3 * p;
        const auto finite = [](const float* c) {
            return std::isfinite(c[0]) && std::isfinite(c[1]) && std::isfinite(c[2]);
        };
        if (both > 0 && finite(r) && finite(t))
            for (size_t c = 0; c < 3; ++c)
                pair.light[c].add(both * double(r[c]), both * double(t[c]));
    }

    const Coverage &m_reference, &m_test;
    const CoveredPixels& m_pixels;
    std::unordered_map<uint32_t, size_t> m_places;
    std::vector<CoveragePair> m_pairs;
};

} // namespace

uint32_t cryptomatte_id(std::string_view name) {
    const uint32_t hash = murmur3(name);
    const uint32_t exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

Coverage::Row Coverage::decode(const std::vector<float>& ranks, size_t pairs,
                               const uint8_t* ignored) {
    Row row;
    for (size_t at = 0; at < ranks.size(); at += 2 * pairs) {
        if (ignored && ignored[at / (2 * pairs)] != 0) {
            row.counts.push_back(0);
            continue;
        }
        const size_t first = row.shares.size();
        double total = 0;
        for (size_t i = at; i < at + 2 * pairs; i += 2) {
            const float coverage = ranks[i + 1];
            if (!std::isfinite(coverage) || !(coverage > 0))
                continue;
            uint32_t id = 0;
            std::memcpy(&id, &ranks[i], sizeof id);
            add_share(row.shares, first, id, double(coverage));
            total += double(coverage);
        }
        const double scale = std::max(1.0, total);
        for (size_t i = first; i < row.shares.size(); ++i)
            row.shares[i].coverage /= scale;
        if (const double rest = 1 - total / scale; rest > 0)
            add_share(row.shares, first, kNone, rest);
        row.counts.push_back(uint32_t(row.shares.size() - first));
    }
    return row;
}

void Coverage::add(const Row& row) {
    size_t end = m_shares.size();
    for (const uint32_t count : row.counts)
        m_ends.push_back(end += count);
    m_shares.insert(m_shares.end(), row.shares.begin(), row.shares.end());
}

double Coverage::of(size_t pixel, uint32_t id) const {
    for (const Share* share = begin(pixel); share != end(pixel); ++share)
        if (share->id == id)
            return share->coverage;
    return 0;
}

std::vector<CoveragePair> compare_coverage(const Coverage& reference, const Coverage& test,
                                           const CoveredPixels& pixels) {
    return PairSums(reference, test, pixels).run();
}

} // namespace tonetool::metrics
