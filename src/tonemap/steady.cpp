// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/steady.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace tonetool::tonemap {
namespace {

constexpr float kFade = 3;             ///< frames, of the weight in time
constexpr float kChange = 0.1f;        ///< of the local light, natural logarithm
constexpr float kOfNoise = 3;          ///< standard deviations of noise that differ no more
constexpr float kLeastNoise = 1e-6f;   ///< variance
constexpr double kLeastShare = 0.05;   ///< of four pixels, that show the surface
constexpr float kFootprints = 2;       ///< that positions may be apart
constexpr float kAlikeNormals = 0.95f; ///< cosine
constexpr float kAlikeAlbedo = 0.05f;  ///< in any channel
constexpr float kAlikeMotion = 1;      ///< pixels, between the ways there and back

// What a pixel of another frame differs by from that of the frame itself.
struct History {
    double value = 0, mean = 0, variance = 0;
};

// A pixel's place in another frame; pixel 0 has its centre at 0.5.
struct Place {
    double x = 0, y = 0;
};

// The four pixels about a place and their weights.
template <class Take>
void each_neighbour(const SteadyView& frame, const Place& place, const Take& take) {
    const double x = place.x - 0.5, y = place.y - 0.5;
    if (!(x > -1 && x < frame.width && y > -1 && y < frame.height))
        return;
    const double left = std::floor(x), top = std::floor(y);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const int px = int(left) + i, py = int(top) + j;
            const double weight = (1 - std::abs(x - px)) * (1 - std::abs(y - py));
            if (weight > 0 && px >= 0 && px < frame.width && py >= 0 && py < frame.height)
                take(ptrdiff_t(py) * frame.width + px, weight);
        }
}

float squared_distance(const SteadyPixel& a, const SteadyPixel& b) {
    const float x = a.position[0] - b.position[0], y = a.position[1] - b.position[1],
                z = a.position[2] - b.position[2];
    return x * x + y * y + z * z;
}

// Follows one pixel of the frame through the others.
class Follower {
public:
    Follower(const std::vector<SteadyView>& frames, const SteadyOwn& own)
        : m_frames(frames),
          m_own(own),
          m_frame(frames[own.at]) {}

    /// False: it shows no surface that others could show.
    bool begin(int x, int y) {
        m_x = x;
        m_y = y;
        m_i = ptrdiff_t(y) * m_frame.width + x;
        m_pixel = &m_frame.pixels[m_i];
        m_chained = false;
        const float footprint =
            m_own.footprint ? m_own.footprint[m_i] : float(m_own.usual_footprint);
        m_apart = kFootprints * footprint * kFootprints * footprint;
        return is_surface(m_frame, m_i) && std::isfinite(m_pixel->value);
    }

    std::optional<History> in(size_t k) {
        const SteadyView& other = m_frames[k];
        if (const auto still = at_the_same_place(other))
            return still;
        Place place;
        if (other.camera &&
            project(*other.camera, m_pixel->position, other.width, other.height, place.x, place.y))
            if (const auto found =
                    mean_about(other, place, [&](ptrdiff_t i) { return is_here(other, i); }))
                return found;
        return m_frame.motion ? along_motion(k) : std::nullopt;
    }

private:
    static bool is_surface(const SteadyView& frame, ptrdiff_t i) {
        return !(frame.background && frame.background[i]);
    }

    // Whether a pixel may show the same material, turned the same way.
    bool is_alike(const SteadyView& other, ptrdiff_t i) const {
        const SteadyPixel& pixel = other.pixels[i];
        if (!is_surface(other, i) || !std::isfinite(pixel.value) || !std::isfinite(pixel.mean))
            return false;
        if (m_frame.has_normal && other.has_normal) {
            float cosine = 0;
            for (size_t c = 0; c < 3; ++c)
                cosine += float(pixel.normal[c]) * float(m_pixel->normal[c]);
            if (!(cosine > kAlikeNormals * kNormalSteps * kNormalSteps))
                return false;
        }
        if (m_frame.has_albedo && other.has_albedo)
            for (size_t c = 0; c < 3; ++c)
                if (!(std::abs(int(pixel.albedo[c]) - int(m_pixel->albedo[c])) <
                      int(kAlikeAlbedo * kAlbedoSteps)))
                    return false;
        return true;
    }
    bool is_here(const SteadyView& other, ptrdiff_t i) const {
        return squared_distance(other.pixels[i], *m_pixel) < m_apart && is_alike(other, i);
    }

    // Where nothing moved the pixel itself shows the surface, without the rounding of a camera.
    std::optional<History> at_the_same_place(const SteadyView& other) const {
        if (other.width != m_frame.width || other.height != m_frame.height)
            return std::nullopt;
        const SteadyPixel& pixel = other.pixels[m_i];
        if (!std::equal(pixel.position, pixel.position + 3, m_pixel->position) ||
            !is_here(other, m_i))
            return std::nullopt;
        return History{double(pixel.value) - double(m_pixel->value),
                       double(pixel.mean) - double(m_pixel->mean),
                       double(pixel.variance) - double(m_pixel->variance)};
    }

    template <class Accept>
    std::optional<History> mean_about(const SteadyView& other, const Place& place,
                                      const Accept& accept) const {
        History sum;
        double weights = 0;
        each_neighbour(other, place, [&](ptrdiff_t i, double weight) {
            if (!accept(i))
                return;
            const SteadyPixel& pixel = other.pixels[i];
            weights += weight;
            sum.value += weight * (double(pixel.value) - double(m_pixel->value));
            sum.mean += weight * (double(pixel.mean) - double(m_pixel->mean));
            sum.variance += weight * (double(pixel.variance) - double(m_pixel->variance));
        });
        if (weights < kLeastShare)
            return std::nullopt;
        return History{sum.value / weights, sum.mean / weights, sum.variance / weights};
    }

    // ---- surfaces that move

    std::optional<History> along_motion(size_t k) {
        if (!m_chained)
            chain();
        return m_found[k];
    }

    void chain() {
        m_found.assign(m_frames.size(), std::nullopt);
        m_chained = true;
        follow(-1);
        follow(1);
    }

    // From frame to frame until one does not show it, or is not there.
    void follow(int step) {
        Place place{m_x + 0.5, m_y + 0.5};
        double motion[2];
        if (!motion_of(m_frame.motion[m_i], step, motion))
            return;
        size_t at = m_own.at;
        for (;;) {
            if (step < 0 ? at == 0 : at + 1 == m_frames.size())
                return;
            const size_t next = step < 0 ? at - 1 : at + 1;
            const SteadyView& other = m_frames[next];
            if (other.number != m_frames[at].number + step || !other.motion)
                return;
            place = {place.x + motion[0], place.y + motion[1]};
            const auto accept = [&](ptrdiff_t i) {
                double back[2];
                return is_alike(other, i) && motion_of(other.motion[i], -step, back) &&
                       std::abs(back[0] + motion[0]) < double(kAlikeMotion) &&
                       std::abs(back[1] + motion[1]) < double(kAlikeMotion);
            };
            m_found[next] = mean_about(other, place, accept);
            if (!m_found[next] || !mean_motion(other, place, step, accept, motion))
                return;
            at = next;
        }
    }

    // To the frame before or the next one, y down; false where it is not finite.
    static bool motion_of(const float (&vector)[4], int step, double (&motion)[2]) {
        motion[0] = step < 0 ? double(vector[0]) : -double(vector[2]);
        motion[1] = step < 0 ? -double(vector[1]) : double(vector[3]);
        return std::isfinite(motion[0]) && std::isfinite(motion[1]);
    }

    template <class Accept>
    static bool mean_motion(const SteadyView& other, const Place& place, int step,
                            const Accept& accept, double (&motion)[2]) {
        double sum[2] = {0, 0}, weights = 0;
        each_neighbour(other, place, [&](ptrdiff_t i, double weight) {
            double own[2];
            if (!accept(i) || !motion_of(other.motion[i], step, own))
                return;
            weights += weight;
            sum[0] += weight * own[0];
            sum[1] += weight * own[1];
        });
        motion[0] = sum[0] / weights;
        motion[1] = sum[1] / weights;
        return weights > 0;
    }

    const std::vector<SteadyView>& m_frames;
    const SteadyOwn& m_own;
    const SteadyView& m_frame;
    const SteadyPixel* m_pixel = nullptr;
    int m_x = 0, m_y = 0;
    ptrdiff_t m_i = 0;
    float m_apart = 0; ///< squared
    bool m_chained = false;
    std::vector<std::optional<History>> m_found; ///< along the motion, of all frames
};

// Weighted sums of the differences, in the order of the frames: frames that are all the same leave
// exactly what was there.
class Sums {
public:
    explicit Sums(float noise)
        : m_per_noise(-0.5 / double(kOfNoise * kOfNoise * std::max(noise, kLeastNoise))) {}

    void add(const History& history, double weight_in_time) {
        constexpr double per_change = -0.5 / double(kChange * kChange);
        const double weight = weight_in_time * std::exp(per_change * history.mean * history.mean);
        m_weights += weight;
        m_mean += weight * history.mean;
        m_variance += weight * history.variance;
        const double alike = weight * std::exp(m_per_noise * history.value * history.value);
        m_alike += alike;
        m_value += alike * history.value;
    }
    void add_own() {
        m_weights += 1;
        m_alike += 1;
    }
    History means() const {
        return {m_value / m_alike, m_mean / m_weights, m_variance / m_weights};
    }

private:
    double m_per_noise;
    double m_weights = 0, m_mean = 0, m_variance = 0, m_alike = 0, m_value = 0;
};

class SteadyRow {
public:
    SteadyRow(const std::vector<SteadyView>& frames, const SteadyOwn& own, const EdgeTerms& edges,
              int width)
        : m_frames(frames),
          m_own(own),
          m_edges(edges),
          m_follower(frames, own),
          m_planes(4 * size_t(width)),
          m_width(width) {
        const int number = frames[own.at].number;
        for (const SteadyView& frame : frames)
            m_in_time.push_back(std::exp(-double(std::abs(frame.number - number)) / double(kFade)));
    }

    void run(int x0, int y, float* base, float* gain, float* share) {
        float *const value = m_planes.data(), *const mean = value + m_width,
                     *const variance = mean + m_width, *const unused = variance + m_width;
        const SteadyView& frame = m_frames[m_own.at];
        const ptrdiff_t first = ptrdiff_t(y) * frame.width + x0;
        for (int x = 0; x < m_width; ++x) {
            const SteadyPixel& pixel = frame.pixels[first + x];
            const History off = means_at(x0 + x, y);
            value[x] = float(double(pixel.value) + off.value);
            mean[x] = float(double(pixel.mean) + off.mean);
            variance[x] = std::max(0.0f, float(double(pixel.variance) + off.variance));
            gain[x] = float(std::exp(off.value));
        }
        split_edges(m_edges, {value, m_own.noise + first, mean, variance}, m_width, base,
                    share ? share : unused);
    }

private:
    History means_at(int x, int y) {
        if (!m_follower.begin(x, y))
            return {};
        const ptrdiff_t i = ptrdiff_t(y) * m_frames[m_own.at].width + x;
        Sums sums(m_own.noise[i]);
        for (size_t k = 0; k < m_frames.size(); ++k)
            if (k == m_own.at)
                sums.add_own();
            else if (const auto history = m_follower.in(k))
                sums.add(*history, m_in_time[k]);
        return sums.means();
    }

    const std::vector<SteadyView>& m_frames;
    const SteadyOwn& m_own;
    const EdgeTerms& m_edges;
    Follower m_follower;
    std::vector<double> m_in_time;
    std::vector<float> m_planes;
    int m_width;
};

} // namespace

void steady_base(const std::vector<SteadyView>& frames, const SteadyOwn& own,
                 const EdgeTerms& edges, const kernels::Window& window, const SteadyOutput& output,
                 const kernels::ParallelFor& parallel) {
    parallel(window.height, [&](int64_t y) {
        const ptrdiff_t row = y * output.stride;
        SteadyRow(frames, own, edges, window.width)
            .run(window.x0, window.y0 + int(y), output.base + row, output.gain + row,
                 output.share ? output.share + row : nullptr);
    });
}

} // namespace tonetool::tonemap
