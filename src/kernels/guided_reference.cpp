// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/guided_reference.h"

#include <algorithm>
#include <cmath>

namespace tonetool::kernels {
namespace {

using Vector = const float* const (&)[3];

double squared_distance(Vector p, ptrdiff_t i, ptrdiff_t j) {
    double sum = 0;
    for (const float* plane : p) {
        const double step = double(plane[i]) - double(plane[j]);
        sum += step * step;
    }
    return sum;
}

struct Normal {
    double n[3];

    // Of unit length; 0 where there is none.
    Normal(Vector planes, ptrdiff_t i) {
        double square = 0;
        for (size_t c = 0; c < 3; ++c) {
            n[c] = double(planes[c][i]);
            square += n[c] * n[c];
        }
        for (double& v : n)
            v = square > 1e-30 && square < 1e30 ? v / std::sqrt(square) : 0;
    }
};

double difference(const Normal& a, const Normal& b, NormalTerm term) {
    double dot = 0, distance = 0;
    for (size_t c = 0; c < 3; ++c) {
        dot += a.n[c] * b.n[c];
        distance += (a.n[c] - b.n[c]) * (a.n[c] - b.n[c]);
    }
    return term == NormalTerm::Angle ? 1 - std::abs(dot) : distance;
}

double albedo_distance(Vector albedo, ptrdiff_t i, ptrdiff_t j) {
    double sum = 0;
    for (const float* plane : albedo) {
        const double a = std::isfinite(plane[i]) ? double(plane[i]) : 0;
        const double b = std::isfinite(plane[j]) ? double(plane[j]) : 0;
        sum += (a - b) * (a - b);
    }
    return sum;
}

bool counts(const GuidePlanes& image, const GuidedTerms& terms, ptrdiff_t i) {
    const float v = image.value[i];
    return std::isfinite(v) && v >= terms.least && (!image.range || std::isfinite(image.range[i]));
}

bool is_surface(const GuidePlanes& image, ptrdiff_t i) {
    if (image.background && image.background[i] != 0)
        return false;
    return !image.position[0] ||
           std::all_of(std::begin(image.position), std::end(image.position),
                       [i](const float* p) { return std::abs(p[i]) <= kFarthestPosition; });
}

double footprint(const GuidePlanes& image, const GuidedTerms& terms, ptrdiff_t i) {
    const double f = image.footprint ? double(image.footprint[i]) : terms.footprint;
    return f > double(kLeastFootprint) ? std::min(f, double(kMostFootprint))
                                       : double(kLeastFootprint);
}

// x^2 / 2 sigma^2
double share(double square, double sigma) {
    return square / (2 * sigma * sigma);
}

// Minus the logarithm of the weight between two pixels, without its spatial part.
double guide_exponent(const GuidePlanes& image, const GuidedTerms& terms, ptrdiff_t i,
                      ptrdiff_t j) {
    double out = 0;
    if (image.range) {
        const double step = double(image.range[i]) - double(image.range[j]);
        out += share(step * step, terms.range);
    }
    if (!is_surface(image, i))
        return out;
    if (image.position[0])
        out += share(squared_distance(image.position, i, j),
                     terms.position * footprint(image, terms, i));
    if (image.normal[0])
        out += share(difference({image.normal, i}, {image.normal, j}, terms.normal_term),
                     terms.normal);
    if (image.albedo[0])
        out += share(albedo_distance(image.albedo, i, j), terms.albedo);
    return out;
}

// Calls add(weight, value) on the pixels of the window that count.
template <class Add>
void visit_window(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps, int x,
                  int y, const Add& add) {
    const ptrdiff_t i = (y - image.first_row) * image.stride + x;
    for (const Tap& tap : taps.at(x, y)) {
        const int nx = x + tap.dx, ny = y + tap.dy;
        if (nx < 0 || nx >= image.width || ny < 0 || ny >= image.height)
            continue;
        const ptrdiff_t j = (ny - image.first_row) * image.stride + nx;
        if (!counts(image, terms, j) || is_surface(image, i) != is_surface(image, j))
            continue;
        const double exponent =
            guide_exponent(image, terms, i, j) - double(tap.log2_weight) * std::log(2.0);
        if (-exponent < double(kLeastLog2Weight) * std::log(2.0))
            continue;
        add(std::exp(-exponent), std::min(double(image.value[j]), double(kLargestGuidedValue)));
    }
}

} // namespace

double guided_reference(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                        int x, int y) {
    const ptrdiff_t i = (y - image.first_row) * image.stride + x;
    if (!counts(image, terms, i))
        return double(image.value[i]);
    double sum = 0, weights = 0;
    visit_window(image, terms, taps, x, y, [&](double w, double value) {
        sum += w * value;
        weights += w;
    });
    return weights > 0 ? sum / weights : double(image.value[i]);
}

GuidedMoments moments_reference(const GuidePlanes& image, const GuidedTerms& terms,
                                const TapSets& taps, int x, int y) {
    const double mean = guided_reference(image, terms, taps, x, y);
    if (!counts(image, terms, (y - image.first_row) * image.stride + x))
        return {mean, 0};
    double sum = 0, weights = 0;
    visit_window(image, terms, taps, x, y, [&](double w, double value) {
        sum += w * (value - mean) * (value - mean);
        weights += w;
    });
    const double variance = weights > 0 ? sum / weights : 0;
    return {mean, variance < double(kLeastVariance) ? 0 : variance};
}

} // namespace tonetool::kernels
