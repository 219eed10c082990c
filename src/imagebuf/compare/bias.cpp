// SPDX-License-Identifier: BSD-3-Clause
// bias_check() of include/tonetool/bias.h.
#include "metrics/bias.h"

#include <OpenImageIO/hash.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "imagebuf/compare/annotate.h"
#include "imagebuf/compare/pair.h"
#include "imagebuf/options/bias_options.h"
#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/bands.h"
#include "imagebuf/pixels/deliver.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/ignored_pixels.h"
#include "imagebuf/pixels/parallel.h"
#include "metrics/refusal.h"
#include "tonetool/bias.h"

namespace tonetool {
namespace {

using metrics::BiasMap;
using metrics::BiasSide;
using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;
using Images = std::vector<const ImageBuf*>;

// A layer of an image that is a seed of its side.
struct BiasSeed {
    const ImageBuf* image;
    PixelOptions pixels;
};

std::vector<BiasSeed> seeds_of(const Images& images, const BiasOptions& options) {
    std::vector<BiasSeed> seeds;
    for (const ImageBuf* image : images) {
        if (!image)
            throw Refusal("an image is missing");
        if (options.halves.empty())
            seeds.push_back({image, options.pixels});
        for (const std::string& layer : options.halves) {
            seeds.push_back({image, options.pixels});
            seeds.back().pixels.layer = layer;
        }
    }
    return seeds;
}

void check_halves(const BiasOptions& options) {
    const auto& halves = options.halves;
    if (halves.empty())
        return;
    if (halves.size() != 2 || halves[0] == halves[1])
        throw Refusal("halves has \"" + OIIO::Strutil::join(halves, ",") +
                      "\": must be two different layers, A,B");
    if (!options.pixels.layer.empty())
        throw Refusal("layer and halves exclude each other: halves are layers");
}

// What identifies the pixels of a seed.
using Digest = std::vector<OIIO::farmhash::uint128_t>;

Digest digest_of(const ColorPlanes& planes) {
    Digest digest;
    for (const auto& plane : planes.plane)
        digest.push_back(OIIO::farmhash::Fingerprint128(reinterpret_cast<const char*>(plane.data()),
                                                        plane.size() * sizeof(float)));
    return digest;
}

// The seeds of one side: one that stays in memory, or the sums of several.
class SideReader {
public:
    /// `ignored` as metrics::bias_check() takes it.
    SideReader(const char* who, const uint8_t* ignored, int nthreads)
        : m_who(who),
          m_ignored(ignored),
          m_nthreads(nthreads) {}

    void add(ColorPlanes&& planes, size_t count, BiasSummary& summary) {
        note(planes, summary);
        fill_nonfinite(planes, std::numeric_limits<float>::quiet_NaN());
        if (count == 1) {
            m_planes = std::move(planes);
            m_side.emplace(m_planes.view());
            return;
        }
        if (!m_side)
            m_side.emplace(planes.width(), planes.region.height());
        if (planes.counts.largest > 0)
            refuse_twice(digest_of(planes));
        m_side->add(planes.view(), make_parallel(m_nthreads));
        if (m_seeds > 1)
            refuse_other_version(planes);
        m_planes = m_seeds < int(count) ? std::move(planes) : ColorPlanes(); // for the next one
    }
    const BiasSide& side() const { return *m_side; }
    const FlipSide& found() const { return m_found; }

private:
    void note(const ColorPlanes& planes, BiasSummary& summary) {
        const FlipSide one = side_of(planes);
        ++m_seeds;
        if (m_seeds == 1) {
            m_found = one;
        } else {
            m_found.nonfinite += one.nonfinite;
            m_found.negative += one.negative;
            m_found.uncovered += one.uncovered;
        }
        check_finite(planes, std::string("the ") + m_who);
        warn_of_holes(one,
                      std::string("the ") + m_who +
                          (m_seeds > 1 ? " (seed " + std::to_string(m_seeds) + ")" : ""),
                      summary.warnings);
    }

    // Two seeds are independent: alike, but not the same.
    void refuse_twice(const Digest& digest) {
        const auto found = std::find(m_digests.begin(), m_digests.end(), digest);
        if (found != m_digests.end()) {
            throw Refusal(format("seeds {} and {} of the {} are the same image: renders of "
                                 "different random numbers have different noise",
                                 found - m_digests.begin() + 1, m_seeds, m_who));
        }
        m_digests.push_back(digest);
    }

    // Images of both sides in one would have their difference in the noise of both. What is found
    // at this level is no matter of chance, however many seeds there are.
    void refuse_other_version(const ColorPlanes& planes) const {
        constexpr double level = 1e-4;
        BiasTest test;
        test.alpha = level;
        const BiasResult found =
            metrics::bias_check(BiasSide(m_planes.view()), BiasSide(planes.view()), test,
                                make_parallel(m_nthreads), m_ignored);
        const auto differs = [](const auto& one) { return one.rejected > 0; };
        if (std::any_of(found.gain.begin(), found.gain.end(), differs) ||
            std::any_of(found.scales.begin(), found.scales.end(), differs)) {
            throw Refusal(format("seeds {} and {} of the {} differ in more than their noise ({}): "
                                 "they are not of one version; the references come first, then "
                                 "the tests",
                                 m_seeds - 1, m_seeds, m_who,
                                 OIIO::Strutil::join(metrics::bias_evidence(found), "; ")));
        }
    }

    const char* m_who;
    const uint8_t* m_ignored;
    int m_nthreads;
    int m_seeds = 0;
    ColorPlanes m_planes;
    std::optional<BiasSide> m_side;
    FlipSide m_found;
    std::vector<Digest> m_digests;
};

// All images, brought to the same pixels, read one after another.
class BiasRun {
public:
    BiasRun(const BiasOptions& options, int nthreads) : m_options(options), m_nthreads(nthreads) {
        m_pair.size = options.size;
        m_pair.memory = options.memory;
    }

    void open(const std::vector<BiasSeed>& references, const std::vector<BiasSeed>& tests,
              BiasSummary& summary) {
        m_references = references;
        m_tests = tests;
        const ImageBuf& first = *references.front().image;
        for (const auto* side : {&references, &tests})
            for (const BiasSeed& seed : *side)
                fit(first, seed, side == &tests, summary);
        m_region = m_fitted.front()->region();
        for (const auto& fitted : m_fitted)
            m_region = OIIO::roi_union(m_region, fitted->region());
        if (m_options.size == SizePolicy::Crop)
            for (const auto& fitted : m_fitted)
                m_region = OIIO::roi_intersection(m_region, plane_of(fitted->image().roi_full()));
        if (m_region.width() <= 0 || m_region.height() <= 0)
            throw Refusal("nothing to compare: the display windows do not overlap");
        for (const auto& fitted : m_fitted)
            fitted->set_region(m_region);
        summary.region = m_region;
        m_ignored.open(m_options, first.spec(), m_region);
        summary.ignored = m_ignored.share(m_region);
        warn_of_ignored(summary.ignored, summary.warnings);
        check_memory();
    }

    const IgnoredPixels& ignored() const { return m_ignored; }

    BiasResult judge(BiasSummary& summary) {
        const uint8_t* ignored = m_ignored.any() ? m_ignored.all().data() : nullptr;
        SideReader reference("reference", ignored, m_nthreads), test("test", ignored, m_nthreads);
        for (size_t i = 0; i < m_fitted.size(); ++i) {
            const bool of_test = i >= m_references.size();
            read(i, of_test ? test : reference, of_test ? m_tests.size() : m_references.size(),
                 summary);
        }
        summary.reference = reference.found();
        summary.test = test.found();
        BiasResult result = metrics::bias_check(reference.side(), test.side(), m_options,
                                                make_parallel(m_nthreads), ignored);
        result.x = m_region.xbegin;
        result.y = m_region.ybegin;
        refuse_holes(result);
        return result;
    }

private:
    // A stray one is a pixel less; of a picture of them nothing can be said.
    void refuse_holes(const BiasResult& result) const {
        constexpr double most = 0.01;
        const auto pixels = double(m_ignored.counted(m_region));
        if (double(result.nonfinite) > most * pixels) {
            throw Refusal(format("{} of {} pixels are NaN or Inf in one of the images, more than "
                                 "{:g} %: there is too little left to compare",
                                 result.nonfinite, pixels, 100 * most));
        }
    }

    void fit(const ImageBuf& first, const BiasSeed& seed, bool of_test, BiasSummary& summary) {
        PairOptions pair = m_pair;
        pair.pixels = seed.pixels;
        m_fitted.push_back(std::make_unique<FittedTest>());
        FittedTest& fitted = *m_fitted.back();
        fitted.call(of_test ? "test" : "reference");
        fitted.keep_negative();
        of_side(side_name(of_test ? "test" : "reference", *seed.image),
                [&] { fitted.open(first, *seed.image, pair, m_nthreads); });
        for (const std::string& note : fitted.notes())
            if (std::find(summary.warnings.begin(), summary.warnings.end(), note) ==
                summary.warnings.end())
                summary.warnings.push_back(note);
    }

    // Planes of floats and marks while a seed is read; of several seeds five planes of doubles. The
    // sums of blocks are small beside them.
    void check_memory() const {
        constexpr uint64_t planes = 3 * sizeof(float) + 1, sums = 5 * sizeof(double), blocks = 16;
        const auto pixels = uint64_t(m_region.width()) * uint64_t(m_region.height());
        const bool several_r = m_references.size() > 1, several_t = m_tests.size() > 1;
        const uint64_t pixel = (several_r ? sums : planes) + (several_t ? sums : planes) +
                               (several_r || several_t ? 2 * planes : 0) + blocks;
        const uint64_t least = kSetAside + m_ignored.bytes() + pixels * pixel;
        if (m_options.memory > 0 && least > m_options.memory)
            throw Refusal("memory is " + size_text(m_options.memory) + ": needs at least " +
                          size_text(least));
    }

    void read(size_t i, SideReader& side, size_t count, BiasSummary& summary) {
        const FittedTest& fitted = *m_fitted[i];
        ColorReader reader;
        reader.ignore(m_ignored.any() ? &m_ignored : nullptr);
        fitted.open_reader(false, m_nthreads, reader);
        if (m_options.memory > 0)
            reader.save_memory();
        ColorPlanes planes = fitted.planes(reader);
        check_covered(planes, i < m_references.size() ? "the reference" : "the test");
        of_side(fitted.name(), [&] { reader.read(m_region.ybegin, m_region.yend, planes); });
        side.add(std::move(planes), count, summary);
    }

    const BiasOptions& m_options;
    int m_nthreads;
    PairOptions m_pair;
    std::vector<BiasSeed> m_references, m_tests;
    std::vector<std::unique_ptr<FittedTest>> m_fitted;
    ROI m_region;
    IgnoredPixels m_ignored;
};

// ---- maps

struct MapPlanes {
    const char* name;
    BiasMap map;
    std::vector<const char*> channels; ///< of the planes that say something
};

const MapPlanes kMapPlanes[] = {
    {kBiasMaps[0], BiasMap::Signed, {"difference", "halfwidth", "confidence"}},
    {kBiasMaps[1], BiasMap::P, {"p16", "p32", "p64"}},
    {kBiasMaps[2], BiasMap::Rejected, {"means", "structures"}}};

// 0 where pixels do not count.
void clear_ignored(const IgnoredPixels& ignored, ImageBuf& map) {
    for (ImageBuf::Iterator<float> p(map); ignored.any() && !p.done(); ++p)
        for (int c = 0; c < map.nchannels() && ignored.at(p.x(), p.y()); ++c)
            p[c] = 0;
}

ImageBuf make_bias_map(const BiasResult& result, const BiasOptions& options, const ROI& region,
                       const ROI& full, int nthreads) {
    std::vector<std::string> names;
    std::vector<BiasMap> asked;
    for (const MapPlanes& one : kMapPlanes) {
        if (options.map != one.name && options.map != kBiasMaps[3])
            continue;
        names.insert(names.end(), one.channels.begin(), one.channels.end());
        asked.push_back(one.map);
    }
    OIIO::ImageSpec spec(region.width(), region.height(), int(names.size()), OIIO::TypeFloat);
    spec.x = region.xbegin;
    spec.y = region.ybegin;
    spec.channelnames = names;
    ImageBuf map = allocated_image(spec);
    map.set_roi_full(full);
    auto* pixels = static_cast<float*>(map.localpixels());
    for (const BiasMap one : asked) {
        metrics::bias_map(result, one, pixels, int(names.size()), make_parallel(nthreads));
        pixels += metrics::bias_map_channels(one);
    }
    return map;
}

void check_bias(ImageBuf& dst, const Images& references, const Images& tests,
                const BiasOptions& options, BiasSummary& summary, int nthreads) {
    check_options(options);
    check_halves(options);
    if (references.empty() || tests.empty())
        throw Refusal(references.empty() ? "there is no reference" : "there is no test");
    BiasRun run(options, nthreads);
    run.open(seeds_of(references, options), seeds_of(tests, options), summary);
    summary.result = run.judge(summary);
    ImageBuf map = make_bias_map(summary.result, options, summary.region,
                                 references.front()->roi_full(), nthreads);
    clear_ignored(run.ignored(), map);
    annotate(map.specmod(), summary);
    deliver(dst, std::move(map), "Bias:");
}

} // namespace

namespace ToneAlgo {

bool bias_check(ImageBuf& dst, const Images& references, const Images& tests,
                const BiasOptions& options, BiasSummary* summary, int nthreads) {
    BiasSummary found;
    if (!guarded(dst, "bias_check",
                 [&] { check_bias(dst, references, tests, options, found, nthreads); }))
        return false;
    if (summary)
        *summary = std::move(found);
    return true;
}

} // namespace ToneAlgo
} // namespace tonetool
