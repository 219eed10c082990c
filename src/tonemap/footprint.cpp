#include "tonemap/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tonetool::tonemap {
namespace {

using kernels::GuidePlanes;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

bool is_surface(const GuidePlanes& image, ptrdiff_t i) {
    return !(image.background && image.background[i] != 0) &&
           std::abs(image.position[0][i]) <= kernels::kFarthestPosition &&
           std::abs(image.position[1][i]) <= kernels::kFarthestPosition &&
           std::abs(image.position[2][i]) <= kernels::kFarthestPosition;
}

// Squared distance in space; infinite to what is no surface.
double squared_step(const GuidePlanes& image, ptrdiff_t i, ptrdiff_t j) {
    if (!is_surface(image, j))
        return INFINITY;
    double sum = 0;
    for (const float* plane : image.position) {
        const double step = double(plane[i]) - double(plane[j]);
        sum += step * step;
    }
    return sum;
}

// The nearer neighbour along an axis with this stride, `place` along it of `length`.
double nearer(const GuidePlanes& image, ptrdiff_t i, ptrdiff_t stride, int place, int length) {
    const double before = place > 0 ? squared_step(image, i, i - stride) : INFINITY;
    const double after = place + 1 < length ? squared_step(image, i, i + stride) : INFINITY;
    return std::min(before, after);
}

float raw_footprint(const GuidePlanes& image, int x, int y) {
    const ptrdiff_t i = (y - image.first_row) * image.stride + x;
    if (!is_surface(image, i))
        return 0;
    const double along_x = nearer(image, i, 1, x, image.width);
    const double along_y = nearer(image, i, image.stride, y, image.height);
    if (std::isinf(along_x) && std::isinf(along_y))
        return kUnknown;
    if (std::isinf(along_x) || std::isinf(along_y))
        return float(std::sqrt(std::min(along_x, along_y)));
    return float(std::sqrt(std::sqrt(along_x) * std::sqrt(along_y)));
}

// Raw footprints as rows with a margin; those that say nothing are unknown.
class Raw {
public:
    Raw(const GuidePlanes& image, const kernels::ParallelFor& parallel)
        : m_pitch(image.width + 2 * kFootprintReach),
          m_data(size_t(m_pitch) * size_t(image.height + 2 * kFootprintReach), kUnknown) {
        parallel(image.height, [&](int64_t y) {
            for (int x = 0; x < image.width; ++x) {
                const float f = raw_footprint(image, x, int(y));
                row(int(y))[x] = f > 0 ? f : kUnknown;
            }
        });
    }
    float* row(int y) { return m_data.data() + (y + kFootprintReach) * m_pitch + kFootprintReach; }
    const float* row(int y) const { return const_cast<Raw*>(this)->row(y); }

private:
    ptrdiff_t m_pitch;
    std::vector<float> m_data;
};

// The median of what is known around a pixel, the upper one of two.
float local_median(const Raw& raw, int x, int y) {
    constexpr int side = 2 * kFootprintReach + 1;
    std::array<float, size_t(side) * side> known;
    auto end = known.begin();
    for (int dy = -kFootprintReach; dy <= kFootprintReach; ++dy)
        for (int dx = -kFootprintReach; dx <= kFootprintReach; ++dx)
            if (const float f = raw.row(y + dy)[x + dx]; f > 0)
                *end++ = f;
    if (end == known.begin())
        return 0;
    const auto middle = known.begin() + (end - known.begin()) / 2;
    std::nth_element(known.begin(), middle, end);
    return *middle;
}

// Which pixels of a row are certainly within the spread of their local median: as many values
// below f / 4, and up to 4 f, as that takes. Counting is much faster than finding it.
class NearMedian {
public:
    explicit NearMedian(int width)
        : m_known(size_t(width)),
          m_below(size_t(width)),
          m_up_to(size_t(width)) {}

    void count(const Raw& raw, int y) {
        for (auto* counts : {&m_known, &m_below, &m_up_to})
            std::fill(counts->begin(), counts->end(), 0);
        const float* const center = raw.row(y);
        for (int dy = -kFootprintReach; dy <= kFootprintReach; ++dy)
            for (int dx = -kFootprintReach; dx <= kFootprintReach; ++dx)
                add(center, raw.row(y + dy) + dx);
    }
    bool holds(int x) const {
        const int middle = m_known[size_t(x)] / 2;
        return m_below[size_t(x)] <= middle && m_up_to[size_t(x)] > middle;
    }

private:
    void add(const float* center, const float* other) {
        const size_t width = m_known.size();
        for (size_t x = 0; x < width; ++x) {
            m_known[x] += other[x] > 0 ? 1 : 0;
            m_below[x] += other[x] < center[x] / kFootprintSpread ? 1 : 0;
            m_up_to[x] += other[x] <= center[x] * kFootprintSpread ? 1 : 0;
        }
    }
    std::vector<int> m_known, m_below, m_up_to;
};

float least_footprint(const GuidePlanes& image, ptrdiff_t i, double step) {
    const float most = std::max({std::abs(image.position[0][i]), std::abs(image.position[1][i]),
                                 std::abs(image.position[2][i])});
    return float(step * double(most));
}

void finish_row(const GuidePlanes& image, const Raw& raw, double step, int y, float* out) {
    NearMedian near(image.width);
    near.count(raw, y);
    for (int x = 0; x < image.width; ++x) {
        const ptrdiff_t i = (y - image.first_row) * image.stride + x;
        float f = raw.row(y)[x];
        if (!is_surface(image, i)) {
            out[x] = 0;
            continue;
        }
        if (!(f > 0) || !near.holds(x)) {
            const float median = local_median(raw, x, y);
            f = f > 0 ? std::clamp(f, median / kFootprintSpread, median * kFootprintSpread)
                      : median;
        }
        out[x] = std::max(f, least_footprint(image, i, step));
    }
}

} // namespace

void footprints(const GuidePlanes& image, double step, float* out,
                const kernels::ParallelFor& parallel) {
    const Raw raw(image, parallel);
    parallel(image.height,
             [&](int64_t y) { finish_row(image, raw, step, int(y), out + y * image.width); });
}

double median_footprint(const float* plane, int width, int height) {
    std::vector<float> known;
    for (int64_t i = 0; i < int64_t(width) * height; ++i)
        if (plane[i] > 0)
            known.push_back(plane[i]);
    if (known.empty())
        return 0;
    const auto middle = known.begin() + ptrdiff_t(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end());
    return double(*middle);
}

} // namespace tonetool::tonemap
