// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lut/lut_error.h"

#include <algorithm>
#include <cmath>

namespace tonetool {
namespace {

constexpr int kCells = 33, kMostCells = 65, kPerCell = 4, kGreys = 8192, kPerEntry = 4,
              kNearBlack = 320;

// Additive recurrence of the plastic number's kin in three dimensions (M. Roberts, 2018).
constexpr double kStep[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};

class Samples {
public:
    Samples(const LutShaper& shaper, int cells) : m_shaper(shaper), m_cells(cells) {
        m_black = std::max(shaper.shape(0), 0.0);
    }

    std::vector<float> greys(int count) const {
        std::vector<float> rgb;
        for (int i = 0; i <= count; ++i)
            rgb.insert(rgb.end(), 3, light(double(i) / count));
        // An encoding that is infinitely steep at 0 is furthest off close to it.
        for (int i = 1; i <= kNearBlack; ++i)
            rgb.insert(rgb.end(), 3, light(std::exp2(-20.0 * i / kNearBlack) / count));
        return rgb;
    }

    // One plane of cells.
    std::vector<float> plane(int r) {
        std::vector<float> rgb;
        for (int g = 0; g < m_cells; ++g)
            for (int b = 0; b < m_cells; ++b)
                for (int k = 0; k < kPerCell; ++k)
                    add(rgb, {double(r), double(g), double(b)});
        return rgb;
    }

    std::vector<float> rim() {
        std::vector<float> rgb;
        for (int i = 0; i < m_cells; ++i)
            for (int j = 0; j < m_cells; ++j)
                for (int zeros = 1; zeros < 7; ++zeros) {
                    add(rgb, {double(i), double(j), double(j)});
                    for (size_t c = 0; c < 3; ++c)
                        if (zeros & (1 << c))
                            rgb[rgb.size() - 3 + c] = 0;
                }
        return rgb;
    }

private:
    float light(double share) const {
        return float(m_shaper.light(m_black + (1 - m_black) * share));
    }

    void add(std::vector<float>& rgb, const std::array<double, 3>& cell) {
        ++m_count;
        for (size_t c = 0; c < 3; ++c) {
            const double jitter = std::fmod(0.5 + double(m_count) * kStep[c], 1.0);
            rgb.push_back(light((cell[c] + jitter) / m_cells));
        }
    }

    const LutShaper& m_shaper;
    int m_cells;
    double m_black;
    int64_t m_count = 0;
};

using Processors = std::vector<ocio::ConstCPUProcessorRcPtr>;

Processors processors(const LutSteps& steps) {
    Processors all;
    const auto add = [&] {
        all.push_back(
            ocio::Config::CreateRaw()->getProcessor(steps.group)->getDefaultCPUProcessor());
    };
    if (steps.cube) {
        steps.cube->setInterpolation(ocio::INTERP_LINEAR);
        add();
        steps.cube->setInterpolation(ocio::INTERP_TETRAHEDRAL);
    }
    add();
    return all;
}

// Returns the largest; adds to the sum.
double compare(const LutSource& source, const Processors& all, const std::vector<float>& rgb,
               double& sum) {
    std::vector<float> exact = rgb;
    source.exact(exact.data(), ptrdiff_t(exact.size() / 3));
    double largest = 0;
    for (const auto& processor : all) {
        std::vector<float> ours = rgb;
        ocio::PackedImageDesc pixels(ours.data(), long(ours.size() / 3), 1, 3);
        processor->apply(pixels);
        double total = 0;
        for (size_t i = 0; i < ours.size(); ++i) {
            const double off = std::abs(double(ours[i]) - double(exact[i]));
            total += off;
            largest = std::max(largest, off);
        }
        sum += total / double(all.size());
    }
    return largest;
}

} // namespace

void measure_lut(const LutSource& source, const LutShaper& shaper, const LutSteps& steps,
                 LutSummary& summary) {
    const int nodes = steps.cube ? int(steps.cube->getGridSize()) : 0;
    const int cells = std::clamp(nodes - 1, kCells, kMostCells);
    const int entries = steps.table ? int(steps.table->getLength()) : nodes;
    Samples samples(shaper, cells);
    const Processors all = processors(steps);
    double sum = 0;
    const auto add = [&](const std::vector<float>& rgb) {
        const double largest = compare(source, all, rgb, sum);
        summary.samples += int64_t(rgb.size() / 3);
        summary.max_error = std::max(summary.max_error, largest);
        return largest;
    };
    summary.grey_max_error = add(samples.greys(std::max(kGreys, kPerEntry * (entries - 1))));
    for (int r = 0; r < cells; ++r)
        add(samples.plane(r));
    add(samples.rim());
    summary.mean_error = sum / double(3 * summary.samples);
    summary.low = shaper.low();
    summary.high = shaper.high();
}

} // namespace tonetool
