// SPDX-License-Identifier: BSD-3-Clause
// The luminance of the brightest light that lights an image.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imagebuf/lights/light_index.h"

namespace tonetool {

class LightMaximum {
public:
    struct Found {
        double luminance = 0;
        std::string light;     ///< whose it is
        std::string index;     ///< layer of the index, or "groups"
        bool measured = false; ///< in the layer of its group, not by the table
        /// Lights whose luminance could not be had as asked, and what is doubtful.
        std::vector<std::string> lacks, warnings;
        bool additive = true;
    };

    /// `percentile` of the luminances of a group counts as its largest.
    LightMaximum(const OIIO::ImageBuf& image, const PixelOptions& beauty,
                 const LightOptions& options, double percentile, int nthreads)
        : m_image(image),
          m_beauty(beauty),
          m_options(options),
          m_percentile(percentile),
          m_nthreads(nthreads) {}

    void read_table();

    /// Nothing is no error: `why` says why there is nothing.
    std::optional<Found> by_table(std::string& why);
    std::optional<Found> by_groups(std::string& why);

private:
    const OIIO::ImageBuf& index_image() const {
        return m_index_file.initialized() ? m_index_file : m_image;
    }
    const LightTable* table() const { return m_options.table.empty() ? nullptr : &m_table; }
    std::optional<Found> by_layer(const IndexLayer& layer, std::string& why);
    std::optional<IndexLayer> open_index();
    const Light* light_at(int index) const;
    std::optional<Found> by_named_groups(std::string& why);
    void take_group(size_t group, const Light* light, Found& found);
    void scan();
    double maximum_of(size_t group) const;
    static std::optional<Found> finish(Found found, std::string& why, const char* none);

    const OIIO::ImageBuf& m_image;
    const PixelOptions& m_beauty;
    const LightOptions& m_options;
    double m_percentile;
    int m_nthreads;
    LightTable m_table;
    OIIO::ImageBuf m_index_file; ///< of the index, where it is not in the image
    std::optional<LightScan> m_scan;
};

} // namespace tonetool
