// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/matte_findings.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace tonetool::metrics {
namespace {

// Less of a change is no finding.
constexpr double kLeastPixels = 4, kLeastShare = 0.01;
// Smaller areas have no colour that could be told.
constexpr double kLeastArea = 64;
// Gained and lost are alike within this factor: it is elsewhere, not larger or smaller.
constexpr double kAlike = 0.1;
// A change of which others explain this share is theirs.
constexpr double kExplained = 0.5;
// A missing and a new object with this share of their pixels in common are one in place of the
// other.
constexpr double kSamePlace = 0.9;

struct Matte {
    CoveragePair pair;
    AttributedMatte row;

    bool is_gone() const { return pair.b == 0; }
    bool is_new() const { return pair.a == 0; }
};

AttributedMatte row_of(const CoveragePair& pair, double all_error) {
    AttributedMatte row;
    row.pixels_reference = pair.a;
    row.pixels_test = pair.b;
    row.mass = all_error > 0 ? pair.error / all_error : 0;
    row.mean = 2 * pair.error / (pair.a + pair.b);
    row.gained = pair.gained;
    row.lost = pair.lost;
    row.cover = (pair.gained + pair.lost) / (pair.a + pair.b);
    if (pair.a > 0 && pair.b > 0)
        row.shift = {
            {pair.x[1] / pair.b - pair.x[0] / pair.a, pair.y[1] / pair.b - pair.y[0] / pair.a}};
    for (size_t c = 0; c < 3; ++c) {
        row.gain[c] = pair.light[c].gain();
        row.gain_error[c] = pair.light[c].error();
    }
    row.changed = int64_t(pair.changes.size());
    return row;
}

std::string change_of(const Matte& matte) {
    const AttributedMatte& row = matte.row;
    if (matte.is_gone() || matte.is_new())
        return matte.is_gone() ? "missing" : "new";
    const auto [less, more] = std::minmax(row.gained, row.lost);
    return less > kAlike * more    ? "moved or reshaped"
           : row.gained > row.lost ? "larger"
                                   : "smaller";
}

// Who changed most of itself comes first; what lies under its changed pixels is explained by it.
void find_changes(std::vector<Matte*> by_cover) {
    std::sort(by_cover.begin(), by_cover.end(), [](const Matte* a, const Matte* b) {
        return a->row.cover != b->row.cover ? a->row.cover > b->row.cover
                                            : a->row.name < b->row.name;
    });
    std::unordered_map<size_t, double> explained;
    for (Matte* matte : by_cover) {
        AttributedMatte& row = matte->row;
        const double area = (row.pixels_reference + row.pixels_test) / 2;
        if (matte->pair.id == Coverage::kNone ||
            double(row.changed) < std::max(kLeastPixels, kLeastShare * area))
            continue;
        double all = 0, left = 0;
        for (const auto& [pixel, change] : matte->pair.changes) {
            const auto found = explained.find(pixel);
            all += change;
            left += std::max(0.0, change - (found == explained.end() ? 0 : found->second));
        }
        if (left < (1 - kExplained) * all && !matte->is_gone() && !matte->is_new()) {
            row.finding = "uncovered or hidden";
            continue;
        }
        row.finding = change_of(*matte);
        for (const auto& [pixel, change] : matte->pair.changes)
            explained[pixel] += change;
    }
}

// The coverage that each missing id and each new one have in common.
std::map<std::pair<uint32_t, uint32_t>, double>
common_pixels(const Coverage& reference, const Coverage& test,
              const std::unordered_map<uint32_t, Matte*>& gone,
              const std::unordered_map<uint32_t, Matte*>& come) {
    std::map<std::pair<uint32_t, uint32_t>, double> common;
    for (size_t p = 0; p < reference.pixels() && !gone.empty() && !come.empty(); ++p)
        for (const Coverage::Share* a = reference.begin(p); a != reference.end(p); ++a)
            for (const Coverage::Share* b = test.begin(p); b != test.end(p); ++b)
                if (gone.count(a->id) > 0 && come.count(b->id) > 0)
                    common[{a->id, b->id}] += std::min(a->coverage, b->coverage);
    return common;
}

void find_replaced(std::vector<Matte>& mattes, const Coverage& reference, const Coverage& test) {
    std::unordered_map<uint32_t, Matte*> gone, come;
    for (Matte& matte : mattes)
        if (matte.row.finding == "missing" || matte.row.finding == "new")
            (matte.is_gone() ? gone : come)[matte.pair.id] = &matte;
    for (const auto& [ids, shared] : common_pixels(reference, test, gone, come)) {
        AttributedMatte &old = gone.at(ids.first)->row, &other = come.at(ids.second)->row;
        if (old.finding == "missing" && other.finding == "new" &&
            shared >= kSamePlace * std::max(old.lost, other.gained)) {
            old.finding = "replaced by " + other.name;
            other.finding = "replaces " + old.name;
        }
    }
}

void find_colours(std::vector<Matte>& mattes) {
    for (Matte& matte : mattes) {
        const LightRatio* light = matte.pair.light;
        if (matte.row.finding.empty() && std::min(matte.pair.a, matte.pair.b) >= kLeastArea &&
            std::any_of(light, light + 3, [](const LightRatio& one) { return one.differs(); }))
            matte.row.finding = "other colour";
    }
}

} // namespace

std::vector<AttributedMatte>
attributed_mattes(const Coverage& reference, const Coverage& test, const CoveredPixels& pixels,
                  const std::function<std::string(uint32_t)>& name_of) {
    double all_error = 0;
    for (size_t p = 0; p < reference.pixels(); ++p)
        all_error += double(pixels.error[p]);
    std::vector<Matte> mattes;
    for (CoveragePair& pair : compare_coverage(reference, test, pixels)) {
        Matte& matte = mattes.emplace_back();
        matte.row = row_of(pair, all_error);
        matte.row.name = pair.id == Coverage::kNone ? kMatteNone : name_of(pair.id);
        matte.pair = std::move(pair);
    }
    std::vector<Matte*> all;
    for (Matte& matte : mattes)
        all.push_back(&matte);
    find_changes(all);
    find_replaced(mattes, reference, test);
    find_colours(mattes);
    std::vector<AttributedMatte> rows;
    for (Matte& matte : mattes)
        rows.push_back(std::move(matte.row));
    std::sort(rows.begin(), rows.end(), [](const AttributedMatte& a, const AttributedMatte& b) {
        if (a.finding.empty() != b.finding.empty())
            return b.finding.empty();
        return a.mass != b.mass ? a.mass > b.mass : a.name < b.name;
    });
    return rows;
}

} // namespace tonetool::metrics
