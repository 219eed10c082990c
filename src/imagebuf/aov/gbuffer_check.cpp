// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/gbuffer_check.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/aov/gbuffer_pixels.h"
#include "imagebuf/aov/gbuffer_precision.h"

namespace tonetool {
namespace {

using namespace gbuffer;
using OIIO::Strutil::fmt::format;

// A decoded vector as short as this points nowhere: the middle grey of 8 bits has a length of .007.
constexpr double kNoDecodedNormal = 0.05;
// Normals are averaged over a pixel, shorter at edges and on bumps: most of them should be near 1.
constexpr double kNearUnit = 0.1;
// Positions in so few places along each axis do not tell pixels apart.
constexpr double kFewSteps = 8;
// Albedo of metals may exceed 1 a little, filters overshoot; light goes far beyond.
constexpr float kMostAlbedo = 1.5f;

double percent(int64_t part, int64_t whole) {
    return 100.0 * double(part) / double(std::max<int64_t>(whole, 1));
}

class Check {
public:
    Check(GBuffer& g, const GBufferNames& names, const ParallelFor& parallel)
        : m_g(g),
          m_names(names),
          m_parallel(parallel) {}

    void depth();
    void normals();
    void positions();
    void albedo();

private:
    template <class Look>
    Tally look(const Look& f) const {
        return over_pixels(m_g, m_parallel, f);
    }
    template <class... Args>
    void warn(const char* text, const Args&... args) {
        m_g.warnings.push_back(format(text, args...));
    }
    void drop(std::vector<float>* planes, int count, const char* guide,
              const std::optional<GuideChannels>& from, const std::string& why) {
        std::fill_n(planes, count, std::vector<float>());
        warn("{} layer \"{}\" is not used: {}", guide, from ? from->layer : "", why);
    }
    void decode_normals();

    GBuffer& m_g;
    const GBufferNames& m_names;
    const ParallelFor& m_parallel;
};

void Check::depth() {
    if (!m_g.has_depth())
        return;
    enum { Finite, Zero, Negative, Sky, Nan };
    const Tally t = look([&](size_t i, Tally& row) {
        const float d = m_g.depth[i];
        if (m_g.background[i])
            return;
        if (std::isnan(d)) {
            ++row.count[Nan];
            return;
        }
        const bool sky = std::abs(d) >= kFar;
        ++row.count[sky ? Sky : Finite];
        if (sky)
            return;
        row.count[Zero] += d == 0;
        row.count[Negative] += d < 0;
        row.see(0, d);
    });
    const int64_t n = t.count[Finite], negative = t.count[Negative];
    const auto drop_depth = [&](const std::string& why) {
        drop(&m_g.depth, 1, "depth", m_names.depth, why);
    };
    if (n == 0 && t.count[Sky] == 0 && t.count[Nan] > 0)
        return drop_depth("it holds no number");
    if (n > 0 && t.count[Zero] == n)
        return drop_depth("it is zero everywhere");
    if (n > 0 && t.high[0] == 1 && t.low[0] >= 0 && t.low[0] < 1)
        return drop_depth(format("its values run from {:g} to exactly 1: normalised for display, "
                                 "not a distance",
                                 t.low[0]));
    if (negative > 0 && negative + t.count[Zero] == n) {
        for (float& d : m_g.depth)
            d = -d;
        warn("depth layer \"{}\" is negative: its sign is turned", m_names.depth->layer);
    } else if (negative * 100 > n) {
        drop_depth(format("its values run from {:g} to {:g}", t.low[0], t.high[0]));
    }
}

// Normals stored as 0.5 n + 0.5 are in 0..1 and of unit length only once they are decoded.
void Check::normals() {
    if (!m_g.has_normal())
        return;
    enum { Surface, Pointing, Unit, Long, DecodedPointing, DecodedUnit };
    const Tally t = look([&](size_t i, Tally& row) {
        if (m_g.background[i] || is_far(m_g, i))
            return;
        ++row.count[Surface];
        if (!is_finite(m_g.normal, i) || is_zero(m_g.normal, i))
            return;
        for (int c = 0; c < 3; ++c)
            row.see(c, m_g.normal[c][i]);
        const double stored = length(m_g.normal, i), decoded = length(m_g.normal, i, 2, -1);
        ++row.count[Pointing];
        row.count[Unit] += std::abs(stored - 1) <= kNearUnit;
        row.count[Long] += stored > 1 + kNearUnit;
        row.count[DecodedPointing] += decoded >= kNoDecodedNormal;
        row.count[DecodedUnit] += std::abs(decoded - 1) <= kNearUnit;
    });
    if (t.count[Surface] == 0)
        return;
    const double unit = percent(t.count[Unit], t.count[Pointing]);
    const double decoded = percent(t.count[DecodedUnit], t.count[DecodedPointing]);
    // Where a pixel sees leaves or a whole object, nearly all are short; none is long all the same.
    const bool averaged = t.lowest() < -kNearUnit && 100 * t.count[Long] <= t.count[Pointing];
    if (t.count[Pointing] == 0)
        drop(m_g.normal, 3, "normal", m_names.normal, "it is zero or not finite everywhere");
    else if (t.lowest() >= 0 && t.highest() <= 1 && decoded >= 50 && decoded > unit)
        decode_normals();
    else if (unit < 50 && !averaged)
        drop(
            m_g.normal, 3, "normal", m_names.normal,
            format("{:.0f}% of its vectors have a length near 1, with components from {:g} to {:g}",
                   unit, t.lowest(), t.highest()));
}

void Check::decode_normals() {
    warn("normal layer \"{}\" is stored as 0..1: it is taken as 2n - 1", m_names.normal->layer);
    look([&](size_t i, Tally&) {
        const bool none = is_zero(m_g.normal, i) || length(m_g.normal, i, 2, -1) < kNoDecodedNormal;
        for (auto& p : m_g.normal)
            p[i] = none ? 0 : 2 * p[i] - 1;
    });
}

// A position must tell pixels apart: not empty, not clipped to 0..1, not all in one place.
void Check::positions() {
    if (!m_g.has_position())
        return;
    enum { Surface, Placed, Clipped };
    const Tally t = look([&](size_t i, Tally& row) {
        if (m_g.background[i] || is_far(m_g, i) || (m_g.has_normal() && is_zero(m_g.normal, i)))
            return;
        ++row.count[Surface];
        if (!is_finite(m_g.position, i) || is_zero(m_g.position, i) ||
            length(m_g.position, i) >= kFar)
            return;
        ++row.count[Placed];
        int at_end = 0;
        for (int c = 0; c < 3; ++c) {
            const float v = m_g.position[c][i];
            row.see(c, v);
            at_end += v == 0 || v == 1;
        }
        row.count[Clipped] += at_end >= 2;
    });
    const int64_t n = t.count[Placed];
    const double rounding = rounding_of_positions(m_g);
    double side = 0, steps = 0;
    for (int c = 0; c < 3; ++c) {
        const double along = double(t.high[c]) - double(t.low[c]);
        const double most = double(std::max(-t.low[c], t.high[c]));
        side = std::max(side, along);
        steps = std::max(steps, along > 0 ? along / (2 * rounding * most) : 0);
    }
    const auto drop_position = [&](const std::string& why) {
        drop(m_g.position, 3, "position", m_names.position, why);
    };
    // A whole wall of a room of side 1 has one component at an end, only its edges have two.
    const bool clipped = t.lowest() >= 0 && t.highest() <= 1 && 2 * t.count[Clipped] > n && n > 1;
    if (t.count[Surface] > 0 && n == 0)
        drop_position("it is zero, huge or not finite everywhere");
    else if (clipped)
        drop_position(format("all values lie within 0..1 and {:.0f}% of the pixels are clipped",
                             percent(t.count[Clipped], n)));
    else if (n > 1 && steps <= kFewSteps)
        drop_position(
            format("its longest side is {:g} at values from {:g} to {:g}: {:.0f} steps of "
                   "what it is stored in",
                   side, t.lowest(), t.highest(), steps));
}

void Check::albedo() {
    if (!m_g.has_albedo())
        return;
    enum { Surface, Finite, Outside };
    const Tally t = look([&](size_t i, Tally& row) {
        if (m_g.background[i] || is_far(m_g, i))
            return;
        ++row.count[Surface];
        if (!is_finite(m_g.albedo, i))
            return;
        ++row.count[Finite];
        bool outside = false;
        for (int c = 0; c < 3; ++c) {
            const float v = m_g.albedo[c][i];
            row.see(c, v);
            outside = outside || v > kMostAlbedo || v < -0.01f;
        }
        row.count[Outside] += outside;
    });
    const int64_t n = t.count[Finite];
    if (t.count[Surface] > 0 && n == 0)
        drop(m_g.albedo, 3, "albedo", m_names.albedo, "it holds no number");
    else if (t.count[Outside] * 10 > n)
        drop(m_g.albedo, 3, "albedo", m_names.albedo,
             format("{:.0f}% of its pixels are outside 0..1.5, from {:g} to {:g}: light, not "
                    "reflectance",
                    percent(t.count[Outside], n), t.lowest(), t.highest()));
}

} // namespace

void check_gbuffer(GBuffer& g, const GBufferNames& names, const ParallelFor& parallel) {
    Check check(g, names, parallel);
    check.depth();
    check.normals();
    check.positions();
    check.albedo();
    settle_pixels(g, names.position ? names.position->layer : "", parallel);
}

} // namespace tonetool
