// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/qc/against_scan.h"

#include <fnmatch.h>

#include <algorithm>
#include <map>

#include "imagebuf/pixels/layer_name.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/qc/qc_header.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using metrics::PairKind;
using OIIO::ROI;

bool matches(const std::string& pattern, const std::string& name) {
    return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

// A layer is known by its whole name, and without that of its view layer.
bool is_meant(const std::string& pattern, const std::string& name) {
    return matches(pattern, name) || matches(pattern, split_layer(name).layer_name);
}

std::optional<PairKind> data_kind(const std::string& kind) {
    static const std::map<std::string, PairKind> kinds = {
        {"depth", PairKind::Depth},   {"position", PairKind::Position},
        {"normal", PairKind::Normal}, {"vector", PairKind::Motion},
        {"id", PairKind::Ids},        {"data", PairKind::Data}};
    const auto found = kinds.find(kind);
    return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

// Whether a measure fits the channels that a layer has.
bool fits(PairKind kind, size_t channels) {
    return kind != PairKind::Normal || channels >= 3;
}

// Ranks of a Cryptomatte from the fifth id of a pixel on: as many as there are samples for.
bool is_high_rank(const std::string& layer) {
    const size_t digits = layer.find_last_not_of("0123456789") + 1;
    return layer.size() - digits == 2 && layer.substr(digits) > "01";
}

// The pixels of a row that are not 0 in all of the channels.
int64_t filled_pixels(const std::vector<float>& row, size_t channels) {
    int64_t filled = 0;
    for (size_t at = 0; at < row.size(); at += channels)
        filled += std::any_of(row.begin() + ptrdiff_t(at), row.begin() + ptrdiff_t(at + channels),
                              [](float value) { return value != 0; });
    return filled;
}

} // namespace

std::string AgainstScan::Side::moment() const {
    return exact.empty() ? std::string() : fingerprint(hashes.data(), hashes.size());
}

std::optional<std::string> AgainstScan::kind_asked(const std::string& layer) const {
    for (const auto& [pattern, kind] : m_options.kinds)
        if (is_meant(pattern, layer))
            return kind;
    return std::nullopt;
}

std::string AgainstScan::kind_of(const LayerReader::Layer& layer) const {
    if (const auto asked = kind_asked(layer.name))
        return *asked;
    static const std::map<std::string, std::string> names = {
        {"picture", "color"}, {"light", "group"}, {"motion", "vector"}};
    const auto found = names.find(layer.kind);
    return found == names.end() ? layer.kind : found->second;
}

bool AgainstScan::is_skipped(const std::string& name) const {
    return std::any_of(m_options.skip.begin(), m_options.skip.end(),
                       [&](const std::string& pattern) { return is_meant(pattern, name); });
}

void AgainstScan::open(const Images& approved, const Images& parts, int nthreads) {
    m_nthreads = nthreads;
    const QcOptions options{m_options.pixels, {}};
    m_sides[0].reader.open(approved, options);
    m_sides[1].reader.open(parts, options);
    for (Side& side : m_sides)
        for (size_t i = 0; i < side.reader.layers().size(); ++i)
            if (const LayerReader::Layer& layer = side.reader.layers()[i];
                layer.exact && layer.kind != "id")
                side.exact.push_back(i);
    match_layers();
    find_depth();
}

// The layers that are compared.
std::vector<size_t> AgainstScan::listed(size_t side) const {
    std::vector<size_t> listed;
    const std::vector<LayerReader::Layer>& layers = m_sides[side].reader.layers();
    for (size_t i = 0; i < layers.size(); ++i)
        if (!is_skipped(layers[i].name))
            listed.push_back(i);
    return listed;
}

void AgainstScan::match_layers() {
    m_same =
        same_layers(m_sides[0].reader.layers(), listed(0), m_sides[1].reader.layers(), listed(1));
    for (const auto& [theirs, same] : m_same)
        add_pair(theirs, same);
}

std::vector<std::string> AgainstScan::unused() const {
    std::vector<std::string> patterns = m_options.skip, unused;
    for (const auto& [pattern, kind] : m_options.kinds)
        patterns.push_back(pattern);
    for (const std::string& pattern : patterns) {
        const auto fits = [&](const Side& side) {
            const std::vector<LayerReader::Layer>& layers = side.reader.layers();
            return std::any_of(layers.begin(), layers.end(), [&](const LayerReader::Layer& layer) {
                return is_meant(pattern, layer.name);
            });
        };
        if (!fits(m_sides[0]) && !fits(m_sides[1]))
            unused.push_back(pattern);
    }
    return unused;
}

std::vector<AgainstName> AgainstScan::names(size_t side) const {
    std::vector<AgainstName> names;
    const std::vector<size_t> here = listed(side), there = listed(1 - side);
    for (const size_t i : here) {
        const LayerReader::Layer& layer = m_sides[side].reader.layers()[i];
        AgainstName& name = names.emplace_back();
        name.name = layer.name;
        name.kind = kind_of(layer);
        name.part = int(layer.part);
        name.channels = layer.names;
        for (const std::array<size_t, 2>& same : m_same)
            if (same[side] == i)
                name.other =
                    int(std::find(there.begin(), there.end(), same[1 - side]) - there.begin());
    }
    return names;
}

void AgainstScan::add_pair(size_t approved, size_t file) {
    Pair pair;
    pair.layers[0] = approved;
    pair.layers[1] = file;
    const LayerReader::Layer& a = layer(pair, 0);
    const LayerReader::Layer& b = layer(pair, 1);
    pair.window =
        roi_intersection(m_sides[0].reader.window(a.part), m_sides[1].reader.window(b.part));
    if (a.channels.size() != b.channels.size() || pair.window.npixels() == 0)
        return;
    pair.kind = kind_of(a);
    pair.channels[0] = a.channels;
    pair.channels[1] = b.channels;
    pair.alpha[0] = a.alpha;
    pair.alpha[1] = b.alpha;
    pair.data = data_kind(pair.kind);
    if (pair.data && !fits(*pair.data, a.channels.size())) {
        if (kind_asked(a.name)) {
            throw Refusal("kind= says that layer " + shown_layer(a.name) + " is of the kind " +
                          pair.kind + ", which has three channels, and it has " +
                          std::to_string(a.channels.size()) + " (valid: data, or no kind=)");
        }
        pair.kind = "data";
        pair.data = PairKind::Data;
    }
    if (!pair.data)
        pair.light.emplace(pair.window.width(), pair.window.height(), a.channels.size());
    m_pairs.push_back(std::move(pair));
}

void AgainstScan::find_depth() {
    for (const Pair& pair : m_pairs)
        if (m_depth < 0 && pair.kind == "depth")
            m_depth = int(pair.layers[0]);
}

const LayerReader::Layer& AgainstScan::layer(const Pair& pair, size_t side) const {
    return m_sides[side].reader.layers()[pair.layers[side]];
}

std::vector<float> AgainstScan::values(const Pair& pair, size_t side, int y) const {
    const LayerReader& reader = m_sides[side].reader;
    const size_t part = layer(pair, side).part;
    return pair.light ? reader.light(part, pair.channels[side], pair.window, y)
                      : reader.values(part, pair.channels[side], pair.window, y);
}

void AgainstScan::run() {
    LayerReader &theirs = m_sides[0].reader, &ours = m_sides[1].reader;
    const int first = std::min(theirs.first_row(), ours.first_row());
    const int last = std::max(theirs.end_row(), ours.end_row());
    for (int begin = first; begin < last;) {
        const int end = std::min(begin + theirs.rows_at_once(begin), last);
        theirs.read_band(begin, end);
        ours.read_band(begin, end);
        std::vector<Row> rows(size_t(end - begin));
        make_parallel(m_nthreads)(end - begin,
                                  [&](int64_t i) { scan_row(begin + int(i), rows[size_t(i)]); });
        for (int y = begin; y < end; ++y)
            add(y, rows[size_t(y - begin)]);
        begin = end;
    }
}

std::string AgainstScan::hash_row(size_t side, int y) const {
    std::string hashes;
    for (const size_t i : m_sides[side].exact) {
        const LayerReader::Layer& layer = m_sides[side].reader.layers()[i];
        const ROI& window = m_sides[side].reader.window(layer.part);
        if (y < window.ybegin || y >= window.yend)
            continue;
        const std::vector<float> row =
            m_sides[side].reader.values(layer.part, layer.channels, window, y);
        hashes += fingerprint(row.data(), row.size() * sizeof(float));
    }
    return hashes;
}

void AgainstScan::scan_row(int y, Row& row) const {
    for (const Pair& pair : m_pairs)
        row.pairs.push_back(scan_pair_row(pair, y));
    for (size_t side = 0; side < 2; ++side)
        row.hashes[side] = hash_row(side, y);
}

AgainstScan::PairRow AgainstScan::scan_pair_row(const Pair& pair, int y) const {
    PairRow row;
    row.there = y >= pair.window.ybegin && y < pair.window.yend;
    if (!row.there)
        return row;
    const std::vector<float> a = values(pair, 0, y), b = values(pair, 1, y);
    row.filled[0] = filled_pixels(a, pair.channels[0].size());
    row.filled[1] = filled_pixels(b, pair.channels[1].size());
    if (pair.light)
        row.light = pair.light->scan(a, b);
    std::vector<float> depth;
    if (pair.data == PairKind::Position && m_depth >= 0) {
        const LayerReader::Layer& from = m_sides[0].reader.layers()[size_t(m_depth)];
        depth = m_sides[0].reader.values(from.part, {from.channels.front()}, pair.window, y);
    }
    if (pair.data) {
        row.data = metrics::scan_pair(*pair.data, a, b, pair.channels[0].size(),
                                      depth.empty() ? nullptr : depth.data(), y);
    }
    if (pair.alpha[0] >= 0 && pair.alpha[1] >= 0) {
        const auto alpha = [&](size_t side) {
            return m_sides[side].reader.values(layer(pair, side).part, {pair.alpha[side]},
                                               pair.window, y);
        };
        row.alpha = metrics::scan_pair(PairKind::Alpha, alpha(0), alpha(1), 1, nullptr, y);
    }
    return row;
}

void AgainstScan::add(int y, const Row& row) {
    for (size_t i = 0; i < m_pairs.size(); ++i) {
        Pair& pair = m_pairs[i];
        if (!row.pairs[i].there)
            continue;
        if (pair.light)
            pair.light->add(y - pair.window.ybegin, row.pairs[i].light);
        for (size_t side = 0; side < 2; ++side)
            pair.filled[side] += row.pairs[i].filled[side];
        pair.sums.add(row.pairs[i].data);
        pair.alpha_sums.add(row.pairs[i].alpha);
    }
    for (size_t side = 0; side < 2; ++side)
        m_sides[side].hashes += row.hashes[side];
}

AgainstLayer AgainstScan::result_of(const Pair& pair) const {
    AgainstLayer out;
    out.name = layer(pair, 1).name;
    out.kind = pair.kind;
    const metrics::DataPair& sums = pair.sums;
    const double pixels = double(std::max<int64_t>(sums.pixels, 1));
    out.x = int(sums.x) + pair.window.xbegin;
    out.y = int(sums.y);
    if (pair.light) {
        const metrics::LightPair::Result result = pair.light->result();
        out.quantities = {
            {"gain", result.gain}, {"blocks", result.blocks}, {"one_finite", result.one_finite}};
        if (result.none_finite)
            out.quantities["none_finite"] = 1;
        out.x = int(result.x) + pair.window.xbegin;
        out.y = int(result.y) + pair.window.ybegin;
        out.one_finite_x = int(result.one_finite_x) + pair.window.xbegin;
        out.one_finite_y = int(result.one_finite_y) + pair.window.ybegin;
    } else if (*pair.data == PairKind::Normal) {
        out.quantities = {{"median", sums.steps.quantile(0.5)},
                          {"off10", double(sums.off) / double(std::max<int64_t>(sums.both, 1))},
                          {"one", sums.share(sums.one)},
                          {"lost", sums.share(sums.lost)}};
    } else if (*pair.data == PairKind::Motion) {
        out.quantities = {{"median", sums.steps.quantile(0.5)},
                          {"off", sums.share(sums.off)},
                          {"lost", sums.share(sums.lost)}};
    } else if (*pair.data == PairKind::Ids) {
        constexpr double few = 16; // pixels that it covers: those of noise are others
        out.quantities = {{"mismatch", sums.sum / pixels}};
        if (std::max(sums.covered[0], sums.covered[1]) >= few && !is_high_rank(out.name))
            out.quantities["others"] = sums.others();
    } else {
        out.quantities = {{"off", sums.share(sums.off)}};
    }
    if (pair.is_emptied() && !(pair.data == PairKind::Ids && is_high_rank(out.name)))
        out.quantities["emptied"] = 1;
    if (pair.alpha_sums.pixels > 0) {
        out.quantities["alpha_mean"] = pair.alpha_sums.sum / double(pair.alpha_sums.pixels);
        out.quantities["alpha_off"] = pair.alpha_sums.share(pair.alpha_sums.off);
    }
    return out;
}

std::vector<AgainstLayer> AgainstScan::results() const {
    std::vector<AgainstLayer> results;
    for (const Pair& pair : m_pairs)
        results.push_back(result_of(pair));
    return results;
}

} // namespace tonetool
