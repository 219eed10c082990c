// SPDX-License-Identifier: BSD-3-Clause
// The layers of all parts of one file, and their rows.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "imagebuf/aov/aov_layers.h"
#include "imagebuf/aov/light_groups.h"
#include "imagebuf/color/color_source.h"
#include "imagebuf/pixels/row_source.h"
#include "metrics/fault_scan.h"
#include "tonetool/qc.h"

namespace tonetool {

/// Reads bands of rows of all parts at once.
class LayerReader {
public:
    struct Layer {
        std::string name, kind;
        size_t part = 0;
        std::vector<int> channels;      ///< in the part; without alpha, but of ids all
        std::vector<double> weights;    ///< that make one value of them: luminance, or the mean
        std::vector<std::string> names; ///< of all its channels, as in the file
        int alpha = -1;                 ///< in the part; -1 if it has none
        bool exact = false;             ///< its values tell the moment of the frame
    };
    struct Place {
        size_t part = 0;
        int channel = 0;
    };

    /// The images must live as long as this does.
    void open(const std::vector<const OIIO::ImageBuf*>& parts, const QcOptions& options);

    const OIIO::ImageSpec& spec() const { return m_spec; } ///< of all parts together
    const ColorChoice& choice() const { return m_choice; }
    const ColorSpace& space() const { return m_space; }
    const std::vector<Layer>& layers() const { return m_layers; }
    const std::vector<LightGroup>& groups() const { return m_groups; }
    bool has_picture() const { return m_choice.r >= 0; }
    const OIIO::ROI& picture_window() const { return window(place_of(m_choice.r).part); }
    const OIIO::ROI& window(size_t part) const { return m_parts[part].window; }
    Place place_of(int channel) const;
    /// Red, green and blue of a luminance.
    const double (&weights() const)[3] { return m_weights; }

    /// The rows of all parts.
    int first_row() const;
    int end_row() const;
    int rows_at_once(int begin) const { return m_parts[0].source.rows_at_once(begin); }
    void read_band(int begin, int end);
    /// Of the band; null where the part has no such row.
    metrics::ChannelRow row_of(size_t part, int y) const;
    /// Channels of a part over the columns of a window, interleaved; 0 where the part has no such
    /// pixel.
    std::vector<float> values(size_t part, const std::vector<int>& channels,
                              const OIIO::ROI& window, int y) const;
    /// The same of colours: decoded, three of them in linear Rec.709.
    std::vector<float> light(size_t part, const std::vector<int>& channels, const OIIO::ROI& window,
                             int y) const;

private:
    struct Part {
        RowSource source;
        OIIO::ROI window;
        int channels = 0;
        int begin = 0, end = 0; ///< rows that are held
        std::vector<float> pixels;
    };

    void open_parts(const std::vector<const OIIO::ImageBuf*>& parts);
    void list_layers();
    Layer layer_of(const AovLayer& from) const;
    bool belongs(const AovLayer& layer, int channel) const;
    Layer lone_layer(int channel) const;

    std::deque<Part> m_parts;
    OIIO::ImageSpec m_spec;
    ColorChoice m_choice;
    ColorSpace m_space;
    double m_weights[3] = {0, 0, 0};
    std::vector<LightGroup> m_groups;
    std::vector<Layer> m_layers;
};

/// Indices of the layers of two files that are the same, of those listed: by the whole name;
/// without that of the view layer where no layer has the whole name. A beauty without a name, as
/// the first part of a file may have it, is that of the other file.
std::vector<std::array<size_t, 2>> same_layers(const std::vector<LayerReader::Layer>& first,
                                               const std::vector<size_t>& listed_first,
                                               const std::vector<LayerReader::Layer>& second,
                                               const std::vector<size_t>& listed_second);

} // namespace tonetool
