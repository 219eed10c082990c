// SPDX-License-Identifier: BSD-3-Clause
// The cross bilateral filter of CG-TMO, guided by the G-buffer, as planes and numbers: F. Banterle
// et al., Eqs. 3 and 4, with the two terms that others have added.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::kernels {

/// Planes of one image, or of a scanline block that holds all rows which the result depends on. All
/// have the same row stride; planes that are null take no part.
struct GuidePlanes {
    const float* value = nullptr; ///< what is averaged: luminance or a logarithm of it
    const float* position[3] = {nullptr, nullptr, nullptr};
    const float* normal[3] = {nullptr, nullptr, nullptr}; ///< of any length; 0: none
    const float* albedo[3] = {nullptr, nullptr, nullptr};
    const float* range = nullptr;        ///< logarithm of luminance; may be the plane `value`
    const float* footprint = nullptr;    ///< of each pixel, in the unit of positions
    const uint8_t* background = nullptr; ///< not 0: background; so are non-finite positions
    ptrdiff_t stride = 0;
    int width = 0, height = 0; ///< of the whole image
    int first_row = 0;         ///< row of the image that the planes begin with
};

/// How normals n, m differ: |n - m|^2 / 2 s^2 as the paper has it, or (1 - |n m|) / 2 s^2 as
/// its authors' program does, for which both sides of a surface are one.
enum class NormalTerm { Distance, Angle };

/// Standard deviations of the weights.
struct GuidedTerms {
    double position = 8;  ///< in footprints
    double footprint = 1; ///< where no plane gives it
    double normal = 0.25, albedo = 0.25;
    double range = 0.4; ///< in the unit of its plane
    NormalTerm normal_term = NormalTerm::Distance;
    float least = 0; ///< values below it are no luminance; lower for a plane of logarithms
    /// Normals (not their angles) and albedo in steps of 1 / 8191 from -1 to 1, two to a word: less
    /// memory to look through, with weights within a hundredth. For subsets of the window.
    bool in_steps = false;
};

/// Footprints are kept within these, values below this, and positions are no surface beyond it:
/// what is computed from them stays a float.
inline constexpr float kLeastFootprint = 1e-15f, kMostFootprint = 1e15f;
inline constexpr float kLargestGuidedValue = 1e35f, kFarthestPosition = 1e15f;

/// Variances below this are 0: what is left of them in float are roundings.
inline constexpr float kLeastVariance = 1e-7f;

/// Weights whose log2 is below this are 0.
inline constexpr float kLeastLog2Weight = -126.5f;

/// `density`: how many offsets there are about this one, in any unit; the fewer they are, the more
/// each of them counts.
struct Offset {
    int dx = 0, dy = 0;
    double density = 1;
};

/// An offset of the window and log2 of its spatial weight, the Gaussian over the density.
struct Tap {
    int dx, dy;
    float log2_weight;
};

/// Pixels of a row that share one set of offsets. Runs begin at its multiples, counted from the
/// origin of the row.
inline constexpr int kGuidedRun = 64;

/// Where the first run of a row begins: at the first column of the image, or up to a run before it,
/// by a hash of the row, so that neighbouring rows do not change their sets at the same columns.
enum class RunOrigin { FirstColumn, Hashed };

/// The offsets that are sampled: one set for all pixels, or several sets among which a hash of the
/// pixel's coordinates chooses, so that results do not depend on tiles or regions.
class TapSets {
public:
    /// `sets`: 1 or 64 of them, each with (0, 0); sigma in pixels.
    TapSets(const std::vector<std::vector<Offset>>& sets, double sigma,
            RunOrigin origin = RunOrigin::FirstColumn);

    const std::vector<Tap>& at(int x, int y) const { return m_sets[choice(x, y)]; }
    int half() const { return m_half; } ///< largest |dx|, |dy|
    double sigma() const { return m_sigma; }
    /// The first column of the run that a pixel is in; it may be outside the image.
    int run_of(int x, int y) const { return x - (x + origin(y)) % kGuidedRun; }
    /// How far before the multiples of a run's length they may begin.
    int most_before() const { return m_origin == RunOrigin::Hashed ? kGuidedRun : 0; }

private:
    int origin(int y) const;
    size_t choice(int x, int y) const;

    std::vector<std::vector<Tap>> m_sets;
    double m_sigma;
    RunOrigin m_origin;
    int m_half = 0;
};

/// All offsets of the square window, row by row.
std::vector<Offset> whole_window(int half);

} // namespace tonetool::kernels
