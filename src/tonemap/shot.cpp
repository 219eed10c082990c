// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/shot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace tonetool::tonemap {
namespace {

// Of the histogram, in log2 of luminance.
constexpr double kLowest = -20, kBinsPerStop = 2;
constexpr double kLeastMean = 1e-6; ///< of a cell, before its logarithm
constexpr int kReach = 2;           ///< cells that thumbnails are shifted by, at most

// ---- likeness

// Correlation of what two thumbnails share when one is shifted.
double correlation(const std::vector<double>& a, const std::vector<double>& b, int dx, int dy) {
    double n = 0, sa = 0, sb = 0, aa = 0, bb = 0, ab = 0;
    const auto each = [&](auto&& visit) {
        for (int y = std::max(0, dy); y < kThumbnailHeight + std::min(0, dy); ++y)
            for (int x = std::max(0, dx); x < kThumbnailWidth + std::min(0, dx); ++x)
                visit(a[size_t(y * kThumbnailWidth + x)],
                      b[size_t((y - dy) * kThumbnailWidth + x - dx)]);
    };
    each([&](double p, double q) {
        ++n;
        sa += p;
        sb += q;
    });
    each([&](double p, double q) {
        aa += (p - sa / n) * (p - sa / n);
        bb += (q - sb / n) * (q - sb / n);
        ab += (p - sa / n) * (q - sb / n);
    });
    constexpr double flat = 1e-9;
    if (aa < flat || bb < flat)
        return aa < flat && bb < flat ? 1 : 0;
    return ab / std::sqrt(aa * bb);
}

// ---- views

// A mean of logarithms; of one value it is that value, to the bit.
class GeometricMean {
public:
    void add(double value) {
        m_first = m_count == 0 ? value : m_first;
        m_logs += std::log(value);
        ++m_count;
    }
    double value() const {
        return m_count == 0 ? 0 : m_count == 1 ? m_first : std::exp(m_logs / m_count);
    }

private:
    double m_first = 0, m_logs = 0, m_count = 0;
};

// Those of one frame.
class Views {
public:
    void add(const FrameLight& light) {
        m_frame.number = light.frame;
        m_frame.light = m_frame.light ? m_frame.light : &light;
        m_frame.unit = std::max(m_frame.unit, light.unit);
        m_frame.fps = std::max(m_frame.fps, light.fps);
        m_frame.lmax = std::max(m_frame.lmax, light.lmax);
        m_maximum = std::max(m_maximum, light.maximum);
        m_frame.counted += light.counted;
        m_frame.histogram.resize(kLightBins, 0);
        for (size_t i = 0; i < light.histogram.size() && i < m_frame.histogram.size(); ++i)
            m_frame.histogram[i] += light.histogram[i];
        if (light.lwa > 0) {
            m_lwa.add(light.lwa);
            m_geometric.add(light.lwa_geometric);
        }
    }
    ShotFrame together(std::optional<double> white_percentile) const {
        ShotFrame frame = m_frame;
        frame.lwa = m_lwa.value();
        frame.lwa_geometric = m_geometric.value();
        if (white_percentile)
            frame.white = *white_percentile >= 100
                              ? m_maximum
                              : percentile_of(frame.histogram, *white_percentile);
        return frame;
    }

private:
    ShotFrame m_frame;
    GeometricMean m_lwa, m_geometric;
    double m_maximum = 0;
};

// ---- time

using Values = std::array<double, 4>;

Values values_of(const ShotFrame& frame, bool linear) {
    Values all{frame.lwa, frame.lwa_geometric, frame.lmax, frame.white};
    if (!linear)
        for (double& v : all)
            v = v > 0 ? std::log(v) : 0;
    return all;
}

ShotFrame with_values(ShotFrame frame, Values all, bool linear) {
    if (!linear)
        for (double& v : all)
            v = std::exp(v);
    frame.lwa = all[0];
    frame.lwa_geometric = all[1];
    frame.lmax = all[2];
    frame.white = frame.white > 0 ? all[3] : 0;
    return frame;
}

// The mean of the adaptation luminances, and the largest of the others.
ShotFrame steady(const std::vector<ShotFrame>& scene, bool linear) {
    Values sums{};
    ShotFrame out;
    double n = 0;
    for (const ShotFrame& frame : scene) {
        if (!(frame.lwa > 0))
            continue;
        const Values own = values_of(frame, linear);
        for (size_t i = 0; i < own.size(); ++i)
            sums[i] += own[i];
        ++n;
        out.lmax = std::max(out.lmax, frame.lmax);
        out.white = std::max(out.white, frame.white);
    }
    for (double& sum : sums)
        sum /= n;
    const ShotFrame means = with_values({}, sums, linear);
    out.lwa = means.lwa;
    out.lwa_geometric = means.lwa_geometric;
    return out;
}

ShotFrame smooth(const std::vector<ShotFrame>& scene, size_t at, const AdaptTerms& terms) {
    constexpr double seconds = 0.4;
    const double tau = terms.tau.value_or(seconds);
    Values sums{};
    double weights = 0;
    ShotFrame out;
    for (const ShotFrame& frame : scene) {
        if (!(frame.lwa > 0))
            continue;
        const double away = std::abs(double(frame.number) - double(scene[at].number));
        const double weight = std::exp(-away / terms.fps / tau);
        const Values own = values_of(frame, terms.linear);
        for (size_t i = 0; i < own.size(); ++i)
            sums[i] += weight * own[i];
        weights += weight;
        out.white = std::max(out.white, frame.white);
    }
    for (double& sum : sums)
        sum /= weights;
    return with_values(out, sums, terms.linear);
}

ShotFrame eye(const std::vector<ShotFrame>& scene, size_t at, const AdaptTerms& terms) {
    Values state{};
    ShotFrame out;
    const ShotFrame* before = nullptr;
    // In the dark before the first light the eye waits for it.
    for (size_t i = 0; i < scene.size() && (i <= at || !before); ++i) {
        const ShotFrame& frame = scene[i];
        if (!(frame.lwa > 0))
            continue;
        const Values own = values_of(frame, terms.linear);
        const double unit = terms.unit.value_or(frame.unit > 0 ? frame.unit : 1);
        const double tau = terms.tau.value_or(eye_time(frame.lwa * unit));
        const double time = before ? (frame.number - before->number) / terms.fps : 0;
        const double share = before ? 1 - std::exp(-time / tau) : 1;
        for (size_t v = 0; v < own.size(); ++v)
            state[v] += (own[v] - state[v]) * share;
        out.white = std::max(out.white, frame.white);
        before = &frame;
    }
    return with_values(out, state, terms.linear);
}

} // namespace

std::vector<double> thumbnail_of(const float* plane, int width, int height) {
    std::vector<double> cells;
    const auto border = [](int cell, int pixels, int all) {
        return int(int64_t(cell) * pixels / all);
    };
    for (int j = 0; j < kThumbnailHeight; ++j)
        for (int i = 0; i < kThumbnailWidth; ++i) {
            const int x0 = border(i, width, kThumbnailWidth);
            const int y0 = border(j, height, kThumbnailHeight);
            const int x1 = std::max(x0 + 1, border(i + 1, width, kThumbnailWidth));
            const int y1 = std::max(y0 + 1, border(j + 1, height, kThumbnailHeight));
            double sum = 0;
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x) {
                    const float v = plane[ptrdiff_t(y) * width + x];
                    sum += v > 0 && std::isfinite(v) ? double(v) : 0;
                }
            const double mean = sum / (double(x1 - x0) * (y1 - y0));
            cells.push_back(std::log(std::max(mean, kLeastMean)));
        }
    return cells;
}

std::pair<double, double> thumbnail_range() {
    return {std::log(kLeastMean), std::log(double(std::numeric_limits<float>::max()))};
}

std::vector<int64_t> light_histogram(const float* plane, int64_t pixels) {
    std::vector<int64_t> bins(kLightBins, 0);
    for (int64_t i = 0; i < pixels; ++i) {
        if (!(plane[i] > 0) || !std::isfinite(plane[i]))
            continue;
        const double at = std::floor((std::log2(double(plane[i])) - kLowest) * kBinsPerStop);
        ++bins[size_t(std::clamp(at, 0.0, double(kLightBins - 1)))];
    }
    return bins;
}

double likeness(const std::vector<double>& a, const std::vector<double>& b) {
    double best = -1;
    for (int dy = -kReach; dy <= kReach; ++dy)
        for (int dx = -kReach; dx <= kReach; ++dx)
            best = std::max(best, correlation(a, b, dx, dy));
    return best;
}

double percentile_of(const std::vector<int64_t>& histogram, double percentile) {
    const int64_t all = std::accumulate(histogram.begin(), histogram.end(), int64_t(0));
    const double wanted = percentile / 100 * double(all);
    double below = 0;
    for (size_t i = 0; i < histogram.size(); ++i) {
        const auto own = double(histogram[i]);
        if (own > 0 && below + own >= wanted) {
            const double share = std::max(0.0, (wanted - below) / own);
            return std::exp2(kLowest + (double(i) + share) / kBinsPerStop);
        }
        below += own;
    }
    return 0;
}

std::vector<ShotFrame> frames_of(const std::vector<FrameLight>& lights,
                                 std::optional<double> white_percentile) {
    std::map<std::pair<int, std::string>, const FrameLight*> sorted;
    for (const FrameLight& light : lights)
        sorted[{light.frame, light.view}] = &light;
    std::map<int, Views> numbers;
    for (const auto& [key, light] : sorted)
        numbers[light->frame].add(*light);
    std::vector<ShotFrame> frames;
    for (auto& [number, views] : numbers)
        frames.push_back(views.together(white_percentile));
    return frames;
}

std::vector<size_t> find_cuts(const std::vector<ShotFrame>& frames) {
    std::vector<size_t> cuts{0};
    const FrameLight* before = nullptr;
    for (size_t i = 0; i < frames.size(); ++i) {
        if (!(frames[i].lwa > 0))
            continue;
        const FrameLight* own = frames[i].light;
        if (before && likeness(before->thumbnail, own->thumbnail) < kAlike)
            cuts.push_back(i);
        before = own;
    }
    return cuts;
}

double eye_time(double luminance) {
    constexpr double rods = 0.4, cones = 0.1, half = 0.04;
    const double share = half / (half + luminance);
    return share * rods + (1 - share) * cones;
}

ShotFrame adapted(const std::vector<ShotFrame>& scene, size_t at, const AdaptTerms& terms) {
    const bool lit = std::any_of(scene.begin(), scene.end(),
                                 [](const ShotFrame& frame) { return frame.lwa > 0; });
    if (!lit)
        return {};
    return terms.mode == "eye"      ? eye(scene, at, terms)
           : terms.mode == "smooth" ? smooth(scene, at, terms)
                                    : steady(scene, terms.linear);
}

std::string lacking(const std::vector<ShotFrame>& scene) {
    int64_t step = 0;
    for (size_t i = 1; i < scene.size(); ++i) {
        const int64_t own = int64_t(scene[i].number) - scene[i - 1].number;
        step = step == 0 ? own : std::min(step, own);
    }
    std::string text;
    for (size_t i = 1; i < scene.size(); ++i) {
        const int64_t first = scene[i - 1].number + step;
        if (first >= scene[i].number)
            continue;
        const int64_t last = scene[i].number - std::min<int64_t>(step, scene[i].number - first);
        text += (text.empty() ? "" : ", ") + std::to_string(first) +
                (last > first ? "-" + std::to_string(last) : "");
    }
    return text;
}

} // namespace tonetool::tonemap
