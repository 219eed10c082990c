// SPDX-License-Identifier: BSD-3-Clause
// Detail that is steady in time: the base and the logarithm of luminance of a frame as means over
// the frames about it, along the surfaces that the positions tell. There is no recursion: what is
// made of a frame depends on these frames alone, so that parts of a shot make the same.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/views.h"
#include "tonemap/camera_fit.h"
#include "tonemap/local.h"

namespace tonetool::tonemap {

/// Frames that are looked at to each side.
inline constexpr int kSteadyReach = 4;

/// Normals and albedo in whole numbers.
inline constexpr float kNormalSteps = 32767, kAlbedoSteps = 65535;

/// A pixel as the frames about it use it.
struct SteadyPixel {
    float position[3];
    float value;          ///< natural logarithm of luminance; NaN: it has none
    float mean, variance; ///< of the value, about the pixel
    int16_t normal[3];    ///< in kNormalSteps
    uint16_t albedo[3];   ///< in kAlbedoSteps
};

/// A frame: packed planes of width x height.
struct SteadyView {
    int number = 0, width = 0, height = 0;
    const SteadyPixel* pixels = nullptr;
    const uint8_t* background = nullptr; ///< not 0: no surface; null: all are
    bool has_normal = false, has_albedo = false;
    const Projection* camera = nullptr;
    /// Where a surface was in the frame before less where it is, and where it is less where it will
    /// be in the next one: x to the right, y up, in pixels (Blender's Vector). Null: unknown.
    const float (*motion)[4] = nullptr;
};

/// What a frame needs of itself alone.
struct SteadyOwn {
    size_t at = 0;                    ///< its place among the frames
    const float* noise = nullptr;     ///< as of EdgeTerms, a packed plane
    const float* footprint = nullptr; ///< a packed plane; null: as the next
    double usual_footprint = 0;
};

/// Where the results go: planes of the window's size, row stride in floats.
struct SteadyOutput {
    float* base = nullptr;  ///< natural logarithm, with the edge terms
    float* gain = nullptr;  ///< that colours are multiplied by before their base is compressed
    float* share = nullptr; ///< as guided_share; null: not wanted
    ptrdiff_t stride = 0;
};

/// `frames` by their numbers, the frame itself among them; each is looked at where its pixel has
/// the same position, where its camera sees the position, or where motion leads. Pixels that no
/// other frame shows keep their base, with a gain of exactly 1, and so do those of frames that are
/// all the same. The bits do not depend on how `parallel` schedules.
void steady_base(const std::vector<SteadyView>& frames, const SteadyOwn& own,
                 const EdgeTerms& edges, const kernels::Window& window, const SteadyOutput& output,
                 const kernels::ParallelFor& parallel);

} // namespace tonetool::tonemap
