// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/bloom.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tonetool::tonemap {
namespace {

constexpr int kSamples = 15; // of a pixel, in each direction
constexpr double kCore = 0.02;
constexpr double kHaloSlope = 19.75, kHaloAngle = 3, kHaloWavelength = 568;
// In degrees, where the exponential functions of core and halo are below 1e-19.
constexpr double kCoreEnds = 0.14, kHaloEnds = 1.5;

struct Weights {
    double core, cube, square, halo;
};

Weights weights_of(Vision vision) {
    constexpr Weights all[] = {
        {0.384, 0.478, 0.138, 0}, {0.368, 0.478, 0.138, 0.016}, {0.282, 0.478, 0.207, 0.033}};
    return all[size_t(vision)];
}

// The place of one of the samples of a pixel, along one axis.
double sample(int pixel, int i) {
    return pixel + (i + 0.5) / kSamples - 0.5;
}

// A function of the distance in pixels as the mean over a pixel.
template <class Function>
double pixel_mean(int x, int y, const Function& function) {
    double sum = 0;
    for (int j = 0; j < kSamples; ++j) {
        const double dy = sample(y, j);
        for (int i = 0; i < kSamples; ++i) {
            const double dx = sample(x, i);
            sum += function(std::sqrt(dx * dx + dy * dy));
        }
    }
    return sum / (kSamples * kSamples);
}

// The mean of the eye's function over the pixel at (x, y), in which a pixel is `pixel` degrees.
class EyeMean {
public:
    EyeMean(Vision vision, double wavelength, double pixel)
        : m_weights(weights_of(vision)),
          m_wavelength(wavelength),
          m_pixel(pixel) {}

    double operator()(int x, int y) const {
        const double angle = m_pixel * std::hypot(x, y), half = m_pixel * M_SQRT1_2;
        const double halo = kHaloAngle * m_wavelength / kHaloWavelength;
        double mean = pixel_mean(x, y, [&](double r) {
            const double t = r * m_pixel;
            return m_weights.cube * glare_inverse_cube(t) +
                   m_weights.square * glare_inverse_square(t);
        });
        if (angle - half < kCoreEnds)
            mean += m_weights.core *
                    pixel_mean(x, y, [&](double r) { return glare_core(r * m_pixel); });
        if (m_weights.halo > 0 && std::abs(angle - halo) - half < kHaloEnds)
            mean += m_weights.halo * pixel_mean(x, y, [&](double r) {
                        return glare_halo(r * m_pixel, m_wavelength);
                    });
        return mean;
    }

private:
    Weights m_weights;
    double m_wavelength, m_pixel;
};

// Fills what has x >= y, and with it what has not; all of it is scaled to add up to 1.
template <class Mean>
PointSpread normalized(const SpreadSize& size, const Mean& mean,
                       const kernels::ParallelFor& parallel) {
    PointSpread out;
    const int reach = int(size.radius);
    out.width = std::min(reach, size.width - 1) + 1;
    out.height = std::min(reach, size.height - 1) + 1;
    out.share.assign(size_t(out.width) * size_t(out.height), 0.0);
    const auto put = [&](int x, int y, double value) {
        if (x < out.width && y < out.height)
            out.share[size_t(y) * size_t(out.width) + size_t(x)] = value;
    };
    const double most = size.radius * size.radius;
    std::vector<double> sums(size_t(reach) + 1, 0.0); // of rows
    parallel(reach + 1, [&](int64_t row) {
        const int y = int(row);
        for (int x = y; x <= reach && double(x) * x + double(y) * y <= most; ++x) {
            const double value = mean(x, y);
            put(x, y, value);
            put(y, x, value);
            const int alike = x == 0 ? 1 : y == 0 || x == y ? 4 : 8;
            sums[size_t(y)] += alike * value;
        }
    });
    double all = 0;
    for (double sum : sums)
        all += sum;
    for (double& share : out.share)
        share /= all;
    return out;
}

} // namespace

double glare_core(double angle) {
    return 2.61e6 * std::exp(-(angle / kCore) * (angle / kCore));
}

double glare_inverse_cube(double angle) {
    const double t = angle + kCore;
    return 20.91 / (t * t * t);
}

double glare_inverse_square(double angle) {
    const double t = angle + kCore;
    return 72.37 / (t * t);
}

double glare_halo(double angle, double wavelength) {
    const double off = angle - kHaloAngle * wavelength / kHaloWavelength;
    return 436.9 * kHaloWavelength / wavelength * std::exp(-kHaloSlope * off * off);
}

PointSpread eye_spread(Vision vision, double wavelength, double pixel, const SpreadSize& size,
                       const kernels::ParallelFor& parallel) {
    return normalized(size, EyeMean(vision, wavelength, pixel), parallel);
}

PointSpread gaussian_spread(double r, const SpreadSize& size,
                            const kernels::ParallelFor& parallel) {
    // The means over pixels of the two factors of each Gaussian.
    std::array<std::vector<double>, 4> means;
    for (size_t k = 0; k < means.size(); ++k) {
        const double sigma = r / double(8 >> k);
        for (int x = 0; x <= int(size.radius); ++x) {
            double sum = 0;
            for (int i = 0; i < kSamples; ++i) {
                const double off = sample(x, i) / sigma;
                sum += std::exp(-off * off / 2);
            }
            means[k].push_back(sum / (kSamples * sigma));
        }
    }
    const auto mean = [&](int x, int y) {
        double sum = 0;
        for (const std::vector<double>& of : means)
            sum += of[size_t(x)] * of[size_t(y)];
        return sum;
    };
    return normalized(size, mean, parallel);
}

} // namespace tonetool::tonemap
