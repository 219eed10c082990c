// SPDX-License-Identifier: BSD-3-Clause
// CG-TMO: Drago's curve on a base, which the G-buffer guides. F. Banterle et al., Eq. 2 to 4; this
// library sees only numbers and planes.
#pragma once

#include <optional>

#include "kernels/guided.h"
#include "kernels/guided_tile.h"
#include "kernels/local_rows.h"
#include "kernels/views.h"

namespace tonetool::tonemap {

/// A base that is a linear function of the logarithm of luminance within each window, so that it is
/// never steeper than luminance: detail of a variance well below `edge`^2 is left out of it, edges
/// of light are not, and neither is noise.
struct EdgeTerms {
    double edge = 0.16; ///< natural logarithm: what varies by more is an edge
    double denoise = 2; ///< how much of the noise's variance is no detail
    const float* noise =
        nullptr; ///< variance of noise, a packed plane of the image's size; null: none
};

/// Part of a row that edge terms divide: natural logarithms, their noise (null: none), and their
/// means and variances about each pixel.
struct EdgeValues {
    const float *value, *noise, *mean, *variance;
};

/// The base, and the share of the difference from the mean that is in it.
void split_edges(const EdgeTerms& terms, const EdgeValues& of, int count, float* base,
                 float* share);

struct LocalOperator {
    kernels::LocalCurve curve;  ///< `log_base` is set by what follows
    kernels::GuidedTerms terms; ///< `range` and `least` too
    /// The base is a geometric mean of luminance, not an arithmetic one (the paper's): one bright
    /// pixel does not fill it.
    bool logarithmic = false;
    double luminance_sigma = 0;     ///< of the term on log10 of luminance; 0: none, as in the paper
    double least_luminance = 1e-6;  ///< darker pixels count as this in logarithms
    std::optional<EdgeTerms> edges; ///< the base keeps edges; logarithmic, no luminance term
};

/// The base of a window: luminance or, if logarithmic, its natural logarithm. Row stride in floats.
struct LocalBase {
    const float* plane = nullptr;
    ptrdiff_t stride = 0;
};

/// Where the results go: planes of the window's size, row stride in floats. They may be those of
/// the image.
struct LocalOutput {
    float* rgb[3] = {nullptr, nullptr, nullptr}; ///< display light, not clamped
    ptrdiff_t stride = 0;
};

/// Turns a packed plane of luminance into the values that the base averages: their natural
/// logarithms if the base is logarithmic. NaN stays where luminance is not finite or negative.
void take_logarithms(const LocalOperator& what, float* luminance, int width, int height,
                     const kernels::ParallelFor& parallel);

/// The base of a window by the guided filter. The value of `image` is luminance after
/// take_logarithms; its range is not looked at. What is NaN there takes no part. The bits depend
/// neither on the window nor on how `parallel` schedules.
void guided_base(const LocalOperator& what, const kernels::GuidePlanes& image,
                 const kernels::TapSets& taps, const kernels::Window& window, float* base,
                 ptrdiff_t stride, const kernels::ParallelFor& parallel);

/// The means of the window about each pixel and their variances, which edge terms divide by.
void guided_moments(const LocalOperator& what, const kernels::GuidePlanes& image,
                    const kernels::TapSets& taps, const kernels::Window& window,
                    const kernels::MomentsRow& row, const kernels::ParallelFor& parallel);

/// How much of what a pixel differs by from the mean about it is in its base, with edge terms: 0
/// (all is detail) to 1. Row stride of `share` in floats.
void guided_share(const LocalOperator& what, const kernels::GuidePlanes& image,
                  const kernels::TapSets& taps, const kernels::Window& window, float* share,
                  ptrdiff_t stride, const kernels::ParallelFor& parallel);

/// Tone maps a window on the base that guided_base would make, which is not kept.
void tone_map_guided(const LocalOperator& what, const kernels::ConstRgb& color,
                     const kernels::GuidePlanes& image, const kernels::TapSets& taps,
                     const kernels::Window& window, const LocalOutput& output,
                     const kernels::ParallelFor& parallel);

/// The two factors of luminance.
enum class LocalPart { Base, Detail };

/// One of the factors, linear. Where the base is no finite positive number it is luminance, and the
/// detail 1. Row stride of `out` in floats.
void local_part(const LocalOperator& what, const kernels::ConstRgb& color, const LocalBase& base,
                const kernels::Window& window, LocalPart part, float* out, ptrdiff_t stride,
                const kernels::ParallelFor& parallel);

/// Tone maps a window on its base: Eq. 2. Luminance that is not finite or negative becomes black.
void tone_map_local(const LocalOperator& what, const kernels::ConstRgb& color,
                    const LocalBase& base, const kernels::Window& window, const LocalOutput& output,
                    const kernels::ParallelFor& parallel);

} // namespace tonetool::tonemap
