// SPDX-License-Identifier: BSD-3-Clause
// One pass over all channels of a file.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "imagebuf/qc/layer_reader.h"
#include "metrics/detail_scan.h"
#include "metrics/fault_scan.h"
#include "metrics/fingerprints.h"
#include "metrics/object_scan.h"
#include "metrics/rectangle_scan.h"
#include "metrics/value_scan.h"
#include "tonetool/qc.h"

namespace tonetool {

class QcScan {
public:
    struct Layer : LayerReader::Layer {
        metrics::LayerScan scan;
        std::string hashes; ///< of its rows
        std::string hash() const;
    };
    /// Sums of a layer without noise over the cells of the thumbnail.
    struct Guide {
        size_t layer = 0;         ///< among layers()
        std::vector<int> columns; ///< cells of the columns of its part, or -1
        std::vector<double> sums; ///< of each cell those of its channels
        std::vector<int64_t> pixels;
        std::vector<double> means(size_t channels) const;
    };
    /// Left, right, top, bottom.
    using Borders = std::array<metrics::BorderScan, 4>;
    struct Alpha {
        double sum = 0;
        int64_t finite = 0, clear = 0, pixels = 0;
        void add(const Alpha& later);
    };

    /// The images must live as long as this does.
    void open(const std::vector<const OIIO::ImageBuf*>& parts, const QcOptions& options,
              int nthreads);
    void run();

    const OIIO::ImageSpec& spec() const { return m_reader.spec(); } ///< of all parts together
    const ColorChoice& choice() const { return m_reader.choice(); }
    const std::vector<Layer>& layers() const { return m_layers; }
    const std::vector<LightGroup>& groups() const { return m_reader.groups(); }
    const metrics::RangeScan& alpha() const { return m_alpha; }
    const metrics::GroupScan& group_scan() const { return m_group_scan; }
    const std::vector<metrics::Spike>& spikes() const { return m_spikes; }
    int64_t spike_count() const { return m_spike_count; }
    std::string hash() const;
    std::vector<double> cell_means() const;
    /// Red, green and blue of each cell.
    const std::vector<double>& cell_colors() const { return m_colors; }
    const std::vector<double>& cell_peaks() const { return m_peaks; }
    const std::vector<Guide>& guides() const { return m_guides; }
    std::vector<uint16_t> fingerprints() const { return m_fingerprints.codes(); }
    const metrics::DetailScan& detail() const { return m_detail; }
    double magenta() const;
    double speed() const { return m_speed.quantile(0.95); }
    bool has_picture() const { return m_reader.has_picture(); }
    const OIIO::ROI& picture_window() const { return m_reader.picture_window(); }
    /// Pixels of the picture that are lit, and those of them whose alpha is 0.
    int64_t lit() const { return m_lit; }
    const metrics::Hits& unseen() const { return m_unseen; }
    const Alpha& alpha_levels() const { return m_alpha_levels; }
    const std::vector<metrics::FlatRectangle>& rectangles() const { return m_rectangles; }
    const Borders& borders() const { return m_borders; }
    const metrics::ValueScan& values() const { return m_values; }
    /// Of this layer, -1 if there is none of IDs.
    int object_layer() const { return m_object_layer; }
    const metrics::ObjectScan& objects() const { return m_objects; }
    int64_t object_pixels() const; ///< of the layer's data window

private:
    struct Share {
        int64_t some = 0, all = 0;
    };
    struct GuideRow {
        std::vector<double> sums;
        std::vector<int64_t> pixels;
    };
    struct Row {
        std::vector<metrics::LayerScan> layers;
        metrics::RangeScan alpha;
        metrics::PictureRow picture;
        metrics::LightRow light;
        metrics::GroupScan groups;
        std::string hash;
        int64_t lit = 0;
        metrics::Hits unseen;
        Alpha alpha_levels;
        std::vector<std::string> exact; ///< hashes of the layers that have one
        std::vector<metrics::FlatRun> runs;
        metrics::ValueScan values;
        std::array<bool, 2> border{}; ///< whether the outermost pixels equal those inside of them
        std::vector<float> colors;    ///< of the rows at the top, at the bottom, of fingerprints
        std::vector<GuideRow> guides;
        Share magenta;
        std::vector<metrics::StepHistogram::Code> speeds;
        metrics::ObjectScan objects;
    };

    void scan_alpha(int y, const std::vector<float>& rgb, Row& row) const;
    void place_cells();
    std::vector<int> columns_of(const OIIO::ROI& window, int cells) const;
    void choose_guides();
    void scan_guides(int y, Row& row) const;
    void scan_albedo(int y, Row& row) const;
    void scan_motion(int y, Row& row) const;
    void scan_objects(int y, Row& row) const;
    void add_guides(int y, const Row& row);
    const ColorSpace& space() const { return m_reader.space(); }

    void scan_row(int y, Row& row) const;
    void scan_picture_row(int y, Row& row) const;
    void scan_groups(int y, Row& row) const;
    std::string layer_hash(const Layer& layer, const metrics::ChannelRow& pixels) const;
    void scan_places(int y, const std::vector<float>& rgb, Row& row) const;
    void add_places(int y, const Row& row);
    void finish_places();
    void add(int y, const Row& row);
    void scan_neighbourhoods(bool last);
    void add_cells(int y, const metrics::CellRow& cells);
    int64_t display_pixels(int cell_x, int cell_y) const;

    LayerReader m_reader;
    std::vector<Layer> m_layers;
    metrics::CellColumns m_columns; ///< of the picture's data window
    std::vector<Guide> m_guides;
    int m_albedo = -1, m_motion = -1, m_object_layer = -1; ///< among the layers
    int m_nthreads = 0;

    metrics::RangeScan m_alpha;
    int64_t m_lit = 0;
    metrics::Hits m_unseen;
    Alpha m_alpha_levels;
    metrics::RectangleScan m_rectangle_scan{QcPicture::kRectangles};
    std::vector<metrics::FlatRectangle> m_rectangles;
    Borders m_borders;
    metrics::ValueScan m_values;
    std::vector<float> m_row_before; ///< if it was kept
    metrics::GroupScan m_group_scan;
    std::string m_hashes;
    std::vector<double> m_cells, m_colors, m_peaks;
    std::vector<int64_t> m_missing;
    metrics::FingerprintScan m_fingerprints;
    Share m_magenta;
    metrics::StepHistogram m_speed;
    metrics::ObjectScan m_objects;
    metrics::DetailScan m_detail;
    struct Held {
        std::vector<float> largest;
        metrics::LightRow light;
    };
    std::deque<Held> m_held; ///< rows of the picture that later ones may still need
    int m_held_begin = 0;    ///< the first of them
    int m_searched = 0;      ///< the first row whose neighbourhood was not looked at
    std::vector<metrics::Spike> m_spikes;
    int64_t m_spike_count = 0;
};

} // namespace tonetool
