// SPDX-License-Identifier: BSD-3-Clause
// How light spreads about bright pixels: G. Spencer, P. Shirley, K. Zimmerman, D. Greenberg,
// "Physically-Based Glare Effects for Digital Images" (1995), for the eye; a sum of Gaussians as in
// M. Pettineo, "A Closer Look at Tone Mapping" (2010).
#pragma once

#include <vector>

#include "kernels/views.h"

namespace tonetool::tonemap {

/// The four parts of the eye's point spread function, per steradian, at an angle in degrees from
/// the light. The last, the lenticular halo, depends on the wavelength in nm.
double glare_core(double angle);
double glare_inverse_cube(double angle);
double glare_inverse_square(double angle);
double glare_halo(double angle, double wavelength);

/// What the eye is adapted to: daylight, dusk, night.
enum class Vision { Photopic, Mesopic, Scotopic };
/// In nm, of red, green and blue.
inline constexpr double kWavelengths[3] = {611, 549, 467};
/// Beyond this angle nothing is spread.
inline constexpr double kMostGlare = 30;

/// The shares of a pixel's light that go to the pixels at (x, y) from it, for x and y of 0 and more
/// within an image; it is even in both. What is left of 1 leaves the image.
struct PointSpread {
    int width = 0, height = 0;
    std::vector<double> share; ///< width x height
    double at(int x, int y) const { return share[size_t(y) * size_t(width) + size_t(x)]; }
};

/// An image's size in pixels, and how far its light goes.
struct SpreadSize {
    int width = 0, height = 0;
    double radius = 0; ///< in pixels
};

/// The eye's, for pixels of this angle in degrees: each is the mean of 15 x 15 samples, and all
/// within the radius add up to 1.
PointSpread eye_spread(Vision vision, double wavelength, double pixel, const SpreadSize& size,
                       const kernels::ParallelFor& parallel);

/// Four Gaussians of the same weight with sigmas of r/8, r/4, r/2 and r pixels.
PointSpread gaussian_spread(double r, const SpreadSize& size, const kernels::ParallelFor& parallel);
/// Where those end, in r.
inline constexpr double kGaussianReach = 5;

/// Spreads the light of planes of one size, all by one function. Light beyond the borders is lost,
/// none comes from there.
class Spreading {
public:
    Spreading(const PointSpread& spread, int width, int height,
              const kernels::ParallelFor& parallel);

    /// In place, a packed plane of finite light that is not negative. The bits do not depend on how
    /// `parallel` schedules.
    void apply(float* plane, const kernels::ParallelFor& parallel) const;

private:
    int m_width, m_height;       ///< of the planes
    int m_columns, m_rows;       ///< with zeros beyond
    std::vector<double> m_gains; ///< of the frequencies, real since the function is even
};

} // namespace tonetool::tonemap
