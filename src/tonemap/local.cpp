// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/local.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels/curve_constants.h"
#include "tonemap/base.h"

namespace tonetool::tonemap {
namespace {

using kernels::ConstRgb;
using kernels::GuidePlanes;
using kernels::Window;

const double kLn2 = std::log(2.0), kLn10 = std::log(10.0);

// The planes of the value and, with a luminance term, of the range that it compares.
class Planes {
public:
    Planes(const LocalOperator& what, const GuidePlanes& image, const kernels::TapSets& taps,
           const Window& window, const kernels::ParallelFor& parallel)
        : m_planes(image) {
        m_planes.range = nullptr;
        if (what.luminance_sigma == 0)
            return;
        m_planes.range = image.value;
        if (what.logarithmic)
            return;
        const ptrdiff_t first = std::max(0, window.y0 - taps.half()) - image.first_row;
        const ptrdiff_t end =
            std::min(image.height, window.y0 + window.height + taps.half()) - image.first_row;
        m_range.resize(size_t(image.stride) * size_t(end));
        parallel(end - first, [&](int64_t i) {
            const ptrdiff_t at = (first + i) * image.stride;
            kernels::log_rows(image.value + at, m_range.data() + at, image.width,
                              float(what.least_luminance), float(kLn2 / kLn10));
        });
        m_planes.range = m_range.data();
    }

    const GuidePlanes& view() const { return m_planes; }

private:
    GuidePlanes m_planes;
    std::vector<float> m_range;
};

kernels::GuidedTerms terms_of(const LocalOperator& what) {
    kernels::GuidedTerms terms = what.terms;
    // The range of a base of natural logarithms is the base itself.
    terms.range = what.luminance_sigma * (what.logarithmic ? kLn10 : 1);
    terms.least = what.logarithmic ? std::numeric_limits<float>::lowest() : 0;
    return terms;
}

// Tone maps pixels to display light, given their base.
class Recombination {
public:
    Recombination(const LocalOperator& what, const ConstRgb& color, const Window& window,
                  const LocalOutput& output)
        : m_curve(what.curve),
          m_color(color),
          m_window(window),
          m_output(output) {
        m_curve.log_base = what.logarithmic;
    }

    void operator()(int x0, int y, int count, const float* base) const {
        const ptrdiff_t from = (y - m_color.first_row) * m_color.stride + x0;
        const ptrdiff_t to = (y - m_window.y0) * m_output.stride + (x0 - m_window.x0);
        const float* in[3];
        float* out[3];
        for (size_t c = 0; c < 3; ++c) {
            in[c] = m_color.plane[c] + from;
            out[c] = m_output.rgb[c] + to;
        }
        kernels::local_rows(m_curve, base, in, out, count);
    }

private:
    kernels::LocalCurve m_curve;
    const ConstRgb& m_color;
    const Window& m_window;
    const LocalOutput& m_output;
};

// Part of a row of a base with edge terms.
struct EdgeRow {
    int count;
    const float *base, *share;
};

// Pixels that are handed out at once, in buffers on the stack.
constexpr int kEdgePart = 256;

template <class Take>
void each_edge_row(const LocalOperator& what, const GuidePlanes& image,
                   const kernels::TapSets& taps, const Window& window,
                   const kernels::ParallelFor& parallel, const Take& take) {
    guided_moments(
        what, image, taps, window,
        [&](int x0, int y, int count, const float* mean, const float* variance) {
            float base[kEdgePart], share[kEdgePart];
            const float* const value = image.value + (y - image.first_row) * image.stride + x0;
            const float* const plane = what.edges->noise;
            const float* const noise = plane ? plane + ptrdiff_t(y) * image.width + x0 : nullptr;
            for (int x = 0; x < count; x += kEdgePart) {
                const int n = std::min(kEdgePart, count - x);
                split_edges(*what.edges,
                            {value + x, noise ? noise + x : nullptr, mean + x, variance + x}, n,
                            base, share);
                take(x0 + x, y, EdgeRow{n, base, share});
            }
        },
        parallel);
}

// Hands out rows of the base.
void each_base(const LocalOperator& what, const GuidePlanes& image, const kernels::TapSets& taps,
               const Window& window, const kernels::ParallelFor& parallel,
               const kernels::GuidedRow& row) {
    if (what.edges)
        return each_edge_row(
            what, image, taps, window, parallel,
            [&](int x0, int y, const EdgeRow& part) { row(x0, y, part.count, part.base); });
    const Planes planes(what, image, taps, window, parallel);
    filter_base(planes.view(), terms_of(what), taps, window, row, parallel);
}

} // namespace

void take_logarithms(const LocalOperator& what, float* luminance, int width, int height,
                     const kernels::ParallelFor& parallel) {
    if (!what.logarithmic)
        return;
    parallel(height, [&](int64_t y) {
        float* const row = luminance + y * width;
        kernels::log_rows(row, row, width, float(what.least_luminance), float(kLn2));
    });
}

void split_edges(const EdgeTerms& terms, const EdgeValues& of, int count, float* base,
                 float* share) {
    const auto edge = float(terms.edge * terms.edge), denoise = float(terms.denoise);
    for (int x = 0; x < count; ++x) {
        const float v = of.variance[x];
        const float of_edge = v / (v + edge);
        const float of_noise =
            of.noise ? std::min(1.0f, denoise * of.noise[x] / std::max(v, 1e-9f)) : 0;
        share[x] = 1 - (1 - of_edge) * (1 - of_noise);
        base[x] = of.mean[x] + share[x] * (of.value[x] - of.mean[x]);
    }
}

void guided_moments(const LocalOperator& what, const GuidePlanes& image,
                    const kernels::TapSets& taps, const Window& window,
                    const kernels::MomentsRow& row, const kernels::ParallelFor& parallel) {
    GuidePlanes planes = image;
    planes.range = nullptr;
    filter_moments(planes, terms_of(what), taps, window, row, parallel);
}

void guided_base(const LocalOperator& what, const GuidePlanes& image, const kernels::TapSets& taps,
                 const Window& window, float* base, ptrdiff_t stride,
                 const kernels::ParallelFor& parallel) {
    each_base(what, image, taps, window, parallel, [&](int x0, int y, int count, const float* row) {
        std::copy_n(row, count, base + (y - window.y0) * stride + (x0 - window.x0));
    });
}

void guided_share(const LocalOperator& what, const GuidePlanes& image, const kernels::TapSets& taps,
                  const Window& window, float* share, ptrdiff_t stride,
                  const kernels::ParallelFor& parallel) {
    each_edge_row(what, image, taps, window, parallel, [&](int x0, int y, const EdgeRow& row) {
        std::copy_n(row.share, row.count, share + (y - window.y0) * stride + (x0 - window.x0));
    });
}

void local_part(const LocalOperator& what, const ConstRgb& color, const LocalBase& base,
                const Window& window, LocalPart part, float* out, ptrdiff_t stride,
                const kernels::ParallelFor& parallel) {
    parallel(window.height, [&](int64_t y) {
        const ptrdiff_t from = (window.y0 - color.first_row + y) * color.stride + window.x0;
        const float* const rgb[3] = {color.plane[0] + from, color.plane[1] + from,
                                     color.plane[2] + from};
        float* const row = out + y * stride;
        kernels::luminance_rows(what.curve.weights, rgb, row, window.width);
        for (int x = 0; x < window.width; ++x) {
            const float l = row[x], b = base.plane[y * base.stride + x];
            const double linear = what.logarithmic ? std::exp(double(b)) : double(b);
            const bool split = linear >= double(kernels::kSmallestLuminance) &&
                               linear <= double(std::numeric_limits<float>::max());
            row[x] = part == LocalPart::Base ? (split ? float(linear) : l)
                                             : (split ? float(double(l) / linear) : 1);
        }
    });
}

void tone_map_guided(const LocalOperator& what, const ConstRgb& color, const GuidePlanes& image,
                     const kernels::TapSets& taps, const Window& window, const LocalOutput& output,
                     const kernels::ParallelFor& parallel) {
    const Recombination recombine(what, color, window, output);
    each_base(what, image, taps, window, parallel,
              [&](int x0, int y, int count, const float* base) { recombine(x0, y, count, base); });
}

void tone_map_local(const LocalOperator& what, const ConstRgb& color, const LocalBase& base,
                    const Window& window, const LocalOutput& output,
                    const kernels::ParallelFor& parallel) {
    const Recombination recombine(what, color, window, output);
    parallel(window.height, [&](int64_t y) {
        recombine(window.x0, window.y0 + int(y), window.width, base.plane + y * base.stride);
    });
}

} // namespace tonetool::tonemap
