// SPDX-License-Identifier: BSD-3-Clause
// One pass over two files, and the layers that both have side by side.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "imagebuf/qc/layer_reader.h"
#include "metrics/data_pair.h"
#include "metrics/light_pair.h"
#include "tonetool/against.h"

namespace tonetool {

class AgainstScan {
public:
    using Images = std::vector<const OIIO::ImageBuf*>;
    struct Side {
        LayerReader reader;
        std::vector<size_t> exact; ///< layers that tell the moment
        std::string hashes;        ///< of their rows
        std::string moment() const;
    };

    explicit AgainstScan(const AgainstOptions& options) : m_options(options) {}
    /// The images must live as long as this does.
    void open(const Images& approved, const Images& parts, int nthreads);
    void run();

    /// 0: approved, 1: new.
    const Side& side(size_t which) const { return m_sides[which]; }
    /// The layers of both files, and which of them are the same.
    std::vector<AgainstName> names(size_t side) const;
    std::vector<std::string> unused() const;
    std::vector<AgainstLayer> results() const;

private:
    // A layer that both have, over the pixels that both have of it.
    struct Pair {
        size_t layers[2];
        std::string kind;
        OIIO::ROI window;
        std::vector<int> channels[2]; ///< of the parts
        std::optional<metrics::LightPair> light;
        std::optional<metrics::PairKind> data;
        metrics::DataPair sums, alpha_sums;
        int alpha[2] = {-1, -1};
        int64_t filled[2] = {0, 0}; ///< pixels that are not 0

        /// Noise leaves no layer empty of which a thousandth, and more than a few pixels, had
        /// something.
        bool is_emptied() const {
            return filled[1] == 0 && filled[0] >= 16 &&
                   double(filled[0]) >= 1e-3 * double(window.npixels());
        }
    };
    struct PairRow {
        bool there = false;
        metrics::LightPair::Row light;
        metrics::DataPair data, alpha;
        int64_t filled[2] = {0, 0};
    };
    struct Row {
        std::vector<PairRow> pairs;
        std::string hashes[2];
    };

    /// That of `kinds`, if one of them means the layer.
    std::optional<std::string> kind_asked(const std::string& layer) const;
    /// As --against calls it.
    std::string kind_of(const LayerReader::Layer& layer) const;
    bool is_skipped(const std::string& layer) const;
    std::vector<size_t> listed(size_t side) const;
    void match_layers();
    void add_pair(size_t approved, size_t file);
    void find_depth();
    const LayerReader::Layer& layer(const Pair& pair, size_t side) const;
    std::vector<float> values(const Pair& pair, size_t side, int y) const;
    void scan_row(int y, Row& row) const;
    PairRow scan_pair_row(const Pair& pair, int y) const;
    std::string hash_row(size_t side, int y) const;
    void add(int y, const Row& row);
    AgainstLayer result_of(const Pair& pair) const;

    AgainstOptions m_options;
    Side m_sides[2];
    std::vector<std::array<size_t, 2>> m_same; ///< layers of both files
    std::vector<Pair> m_pairs;
    int m_depth = -1; ///< layer of the approved file, which says how far positions are
    int m_nthreads = 0;
};

} // namespace tonetool
