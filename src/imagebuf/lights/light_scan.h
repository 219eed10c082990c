// SPDX-License-Identifier: BSD-3-Clause
// The light of every group in every pixel.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "imagebuf/aov/light_groups.h"
#include "imagebuf/color/color_reader.h"
#include "metrics/fault_scan.h"
#include "tonetool/lights.h"

namespace tonetool {

struct ScannedGroup {
    LightGroup group;
    int64_t pixels = 0; ///< it was chosen in
    double maximum = 0; ///< largest luminance; 0: it is black
};

/// Reads the groups of an image band by band and tells which lights each pixel.
class LightScan {
public:
    /// Gets the indices of a row, -1 for none; several rows at the same time.
    using Sink = std::function<void(int y, const int* indices)>;

    /// `beauty` as the picture is read. The image must live as long as this does.
    void open(const OIIO::ImageBuf& image, const PixelOptions& beauty,
              const std::vector<LightGroup>& groups, OIIO::ROI region, int nthreads);
    /// Instead of the largest contribution: of the groups with more than 1 % of a pixel's light
    /// that of the largest value; without a value it comes after all others.
    void rank_by(std::vector<std::optional<double>> values) { m_values = std::move(values); }
    void run(const Sink& sink);

    /// Nearest rank over all pixels of the region.
    double percentile(size_t group, double share) const;

    const std::vector<ScannedGroup>& groups() const { return m_groups; }
    int64_t unlit() const { return m_unlit; }
    /// As in LightIndexSummary.
    double sum() const { return m_compared.sum(); }
    double difference() const { return m_compared.difference(); }
    bool additive() const { return difference() <= LightIndexSummary::kMostDifference; }
    /// What a user should know: groups that do not add up, pixels that are no numbers.
    std::vector<std::string> warnings() const;

private:
    struct Row {
        std::vector<int64_t> pixels;
        std::vector<double> maxima;
        int64_t unlit = 0;
    };

    void compare();
    void scan_row(int y, Row& row, int* indices) const;
    int choose(const float* const* light, size_t x, double total) const;
    bool goes_before(size_t a, size_t b, const float* const* light, size_t x) const;
    void add(const Row& row);

    const OIIO::ImageBuf* m_image = nullptr;
    PixelOptions m_pixels;
    OIIO::ROI m_region;
    int m_nthreads = 0;
    std::vector<ColorReader> m_readers;
    std::vector<ColorPlanes> m_planes;
    std::vector<std::optional<double>> m_values;

    std::vector<ScannedGroup> m_groups;
    int64_t m_unlit = 0;
    metrics::GroupScan m_compared; ///< with the beauty
};

} // namespace tonetool
