// SPDX-License-Identifier: BSD-3-Clause
// Objects, materials and assets of a pair by their Cryptomattes, and the layers beside them.
#include <OpenImageIO/strutil.h>

#include "imagebuf/attribute/attribute_tables.h"
#include "kernels/curve.h"
#include "metrics/errors.h"
#include "metrics/layer_change.h"
#include "metrics/matte_findings.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using metrics::Coverage;
using metrics::LayerPixels;
using metrics::PairKind;

// A layer has changed if this share of the pixels has.
constexpr double kChangedShare = 1e-3;

std::string name_in(const AttributeInput::Type& type, uint32_t id) {
    const auto found = type.names.find(id);
    return found != type.names.end() ? found->second : OIIO::Strutil::fmt::format("<{:08x}>", id);
}

// Ids that were filtered like colours are others, and many.
void check_names(const AttributeInput::Type& type, size_t named, size_t unnamed) {
    constexpr size_t some = 64;
    if (!type.names.empty() && unnamed > some && unnamed > named)
        throw Refusal(OIIO::Strutil::fmt::format(
            "{} ids of {} are not in its manifest, and {} are: they have been resized or filtered, "
            "which destroys them (valid: layers as they were rendered)",
            unnamed, type.name, named));
}

LayerPixels pixels_of(const AttributeInput::Layer& layer) {
    return {{&layer.values[0], &layer.values[1]}, layer.channels};
}

std::vector<std::pair<std::string, double>> most_under(const AttributeInput::Type& type,
                                                       const std::vector<uint8_t>& changed) {
    std::map<uint32_t, double> sums;
    double all = 0;
    for (size_t p = 0; p < changed.size(); ++p) {
        if (changed[p] == 0)
            continue;
        all += 1;
        for (const Coverage& coverage : type.coverage)
            for (const Coverage::Share* share = coverage.begin(p); share != coverage.end(p);
                 ++share)
                sums[share->id] += share->coverage / 2;
    }
    sums.erase(Coverage::kNone);
    std::vector<std::pair<std::string, double>> shares;
    for (const auto& [id, sum] : sums)
        shares.emplace_back(name_in(type, id), sum / all);
    std::sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
        return a.second != b.second ? a.second > b.second : a.first > b.first;
    });
    constexpr size_t most = 2;
    shares.resize(std::min(shares.size(), most));
    return shares;
}

void compare_data(const AttributeInput& input, const AttributeInput::Layer& layer,
                  const metrics::Surfaces& surfaces, AttributedLayer& row) {
    static const std::map<std::string, std::pair<PairKind, const char*>> kinds = {
        {"depth", {PairKind::Depth, "of depth"}},
        {"position", {PairKind::Position, "of the scene's diagonal"}},
        {"normal", {PairKind::Normal, "degrees"}},
        {"id", {PairKind::Ids, "of the pixels"}}};
    const auto& [kind, unit] = kinds.at(layer.kind);
    const metrics::LayerChange change = metrics::layer_change(kind, pixels_of(layer), surfaces);
    row.unit = unit;
    row.mean = change.mean;
    row.max = change.max;
    row.background_changed = change.background_changed;
    row.changed = std::count(change.changed.begin(), change.changed.end(), 1);
    if (double(row.changed) >= kChangedShare * input.counted())
        row.finding = "changed";
    if (!input.types().empty() && row.changed > 0)
        row.most_under = most_under(input.types().front(), change.changed);
}

void compare_colours(const AttributeInput::Layer& layer, AttributedLayer& row) {
    constexpr double eps = 0.01; // --errormap's
    metrics::LightRatio ratio;
    double sum = 0;
    int64_t finite = 0;
    for (size_t at = 0; at < layer.values[0].size(); at += 3) {
        const float *a = &layer.values[0][at], *b = &layer.values[1][at];
        float clamped[2][3], error = 0;
        double y[2] = {0, 0};
        bool sound = true;
        for (size_t c = 0; c < 3; ++c) {
            sound = sound && std::isfinite(a[c]) && std::isfinite(b[c]);
            clamped[0][c] = std::max(a[c], 0.0f);
            clamped[1][c] = std::max(b[c], 0.0f);
            y[0] += double(kernels::kLuminance[c]) * double(a[c]);
            y[1] += double(kernels::kLuminance[c]) * double(b[c]);
        }
        if (!sound)
            continue;
        const float* const r[3] = {&clamped[0][0], &clamped[0][1], &clamped[0][2]};
        const float* const t[3] = {&clamped[1][0], &clamped[1][1], &clamped[1][2]};
        metrics::error_row({metrics::ErrorKind::Symmetric, eps}, {}, r, t, &error, 1);
        ratio.add(y[0], y[1]);
        sum += double(error);
        row.max = std::max(row.max, double(error));
        ++finite;
    }
    row.unit = "SMAPE";
    row.mean = finite > 0 ? sum / double(finite) : 0;
    if (ratio.reference() > 0) {
        row.gain = ratio.gain();
        row.gain_error = ratio.error();
    }
    row.finding = ratio.finding(ratio.reference());
}

} // namespace

std::vector<AttributedType> attribute_mattes(const AttributeInput& input,
                                             const std::vector<float>& error,
                                             const std::vector<float>& test,
                                             std::vector<std::string>& warnings) {
    constexpr size_t most = 1000;
    std::vector<AttributedType> types;
    const metrics::CoveredPixels pixels{size_t(input.region().width()), error.data(),
                                        input.picture()[0].data(), test.data()};
    for (const AttributeInput::Type& type : input.types()) {
        size_t named = 0, unnamed = 0;
        const auto name_of = [&](uint32_t id) {
            ++(type.names.count(id) > 0 ? named : unnamed);
            return name_in(type, id);
        };
        std::vector<AttributedMatte> rows =
            metrics::attributed_mattes(type.coverage[0], type.coverage[1], pixels, name_of);
        check_names(type, named, unnamed);
        if (rows.size() > most) {
            warnings.push_back(OIIO::Strutil::fmt::format("of {} the first {} of {} rows are told",
                                                          type.name, most, rows.size()));
            rows.resize(most);
        }
        types.push_back({type.name, std::move(rows)});
    }
    return types;
}

std::vector<AttributedLayer> attribute_layers(const AttributeInput& input) {
    metrics::Surfaces surfaces;
    for (const AttributeInput::Layer& layer : input.layers())
        if (layer.kind == "depth" && surfaces.in[0].empty())
            surfaces = metrics::surfaces_of(pixels_of(layer));
    if (input.ignored().any())
        for (std::vector<uint8_t>& in : surfaces.in) {
            in.resize(input.pixels(), 1); // without depth
            for (size_t p = 0; p < in.size(); ++p)
                in[p] = in[p] != 0 && input.counts(p);
        }
    std::vector<AttributedLayer> rows;
    for (const AttributeInput::Layer& layer : input.layers()) {
        AttributedLayer& row = rows.emplace_back();
        row.name = layer.name;
        row.kind = layer.kind;
        if (layer.kind == "albedo" || layer.kind == "color")
            compare_colours(layer, row);
        else
            compare_data(input, layer, surfaces, row);
    }
    findings_first(rows);
    return rows;
}

} // namespace tonetool
