// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/compare/flip_run.h"

#include <algorithm>

#include "flip/filters.h"
#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/compare/flip_finish.h"
#include "imagebuf/compare/ignored_alpha.h"
#include "imagebuf/compare/pair.h"
#include "imagebuf/pixels/bands.h"
#include "imagebuf/pixels/ignored_pixels.h"
#include "imagebuf/pixels/parallel.h"
#include "metrics/errors.h"
#include "metrics/luminance.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// One image of a comparison.
struct Side {
    ColorReader reader;
    ColorPlanes planes;
    std::string name; ///< how errors begin

    void read(int begin, int end) {
        of_side(name, [&] { reader.read(begin, end, planes); });
    }
};

// The tests that share one region with the reference, compared together: in bands of rows, of
// which there is one where everything fits into memory.
class Group {
public:
    Group(const FlipPlan& plan, const ImageBuf& reference, int nthreads)
        : m_plan(plan),
          m_image(reference),
          m_nthreads(nthreads),
          m_radius(plan.filters() ? flip::filter_radius(plan.evaluation.taps) : 0) {}

    /// `held`: bytes that earlier groups have made.
    void run(const FittedTest* fitted, const std::vector<ImageBuf*>& dst, const ROI& roi,
             uint64_t held, std::vector<ImageBuf>& maps, std::vector<FlipResult>& results) {
        m_fitted = fitted;
        m_held = held;
        clip(roi);
        open(dst.size());
        measure();
        std::vector<FlipMaps> filled;
        filled.reserve(dst.size());
        for (ImageBuf* map : dst)
            filled.emplace_back(m_plan, m_exposures, m_roi, m_image.roi_full(), *map, m_nthreads);
        for (int begin = m_region.ybegin; begin < m_region.yend;) {
            const int end = m_bands.end_of(begin);
            run_band(begin, end, filled);
            begin = end;
        }
        for (size_t t = 0; t < dst.size(); ++t) {
            const Found found{m_both[t], ignored_alpha(t), m_fitted[t].notes(),
                              m_ignored.share(m_roi)};
            filled[t].finish(m_reference.planes, m_tests[t].planes, found, maps.emplace_back(),
                             results.emplace_back());
        }
    }

    uint64_t map_bytes_made() const { return m_needs.map_row * uint64_t(m_roi.height()); }

private:
    void clip(const ROI& roi) {
        m_region = m_fitted[0].region();
        m_roi = roi.defined() ? OIIO::roi_intersection(roi, m_region) : m_region;
        if (m_roi.width() <= 0 || m_roi.height() <= 0)
            throw Refusal("the region of interest holds no pixel of the images");
        m_ignored.open(m_plan.common, m_image.spec(), m_region);
        (void)m_ignored.counted(m_roi);
    }

    const IgnoredPixels* ignored() const { return m_ignored.any() ? &m_ignored : nullptr; }

    void open(size_t count) {
        m_reference.name = side_name("reference", m_image);
        if (!m_plan.alpha())
            m_reference.reader.watch_alpha();
        m_reference.reader.ignore(ignored(), true);
        of_side(m_reference.name, [&] {
            m_reference.reader.open(m_image, m_plan.common.pixels, m_region, m_plan.alpha(),
                                    m_nthreads);
        });
        m_reference.planes = m_reference.reader.planes();
        m_tests.resize(count);
        m_both.assign(count, {});
        for (size_t t = 0; t < count; ++t) {
            m_tests[t].name = m_fitted[t].name();
            if (!m_plan.alpha())
                m_tests[t].reader.watch_alpha();
            m_tests[t].reader.ignore(ignored());
            m_fitted[t].open_reader(m_plan.alpha(), m_nthreads, m_tests[t].reader);
            m_tests[t].planes = m_fitted[t].planes(m_tests[t].reader);
            if (m_plan.alpha() && m_reference.planes.choice.a < 0 && m_tests[t].planes.choice.a < 0)
                throw Refusal("alpha=error, but neither image has an alpha channel");
            check_covered(m_reference.planes, "the reference");
            check_covered(m_tests[t].planes, "the test");
        }
    }

    // The pixels are looked at once more only where something tells the two apart.
    int64_t ignored_alpha(size_t test) const {
        if (m_plan.only_shown || m_plan.alpha() || m_fitted[test].resized() ||
            m_reference.planes.counts.alpha_digest == m_tests[test].planes.counts.alpha_digest)
            return 0;
        return count_alpha_differences(m_image, m_reference.planes.choice, m_fitted[test].image(),
                                       m_fitted[test].choice(), m_roi, ignored());
    }

    bool keeps_each() const { return m_plan.hdr && m_plan.hdr_options.want_exposures; }

    // Tiles of few rows: their halos take time, but little memory.
    flip::Evaluation bounded() const {
        constexpr int few_rows = 16;
        flip::Evaluation evaluation = m_plan.evaluation;
        evaluation.most_tile_rows = m_plan.common.memory > 0 ? few_rows : 0;
        return evaluation;
    }

    void make_bands(size_t exposures) {
        m_needs = {};
        m_needs.radius = m_radius;
        m_needs.band_rows = m_plan.band_rows;
        if (m_plan.filters())
            m_needs.thread =
                flip::work_bytes(bounded(), m_roi.width(), m_tests.size(), keeps_each());
        m_needs.threads = oiio::threads_of(m_nthreads);
        m_needs.held = m_held + m_ignored.bytes();
        for (size_t i = 0; i <= m_tests.size(); ++i) {
            const ColorReader& reader = i == 0 ? m_reference.reader : m_tests[i - 1].reader;
            m_needs.row += reader.row_bytes();
            m_needs.reading = std::max<uint64_t>(m_needs.reading, reader.bytes_while_saving());
            m_needs.held += reader.kept_bytes();
            if (i > 0)
                m_needs.held += m_fitted[i - 1].held_bytes();
        }
        m_needs.map_row = uint64_t(m_roi.width()) * m_tests.size() * map_bytes(m_plan, exposures);
        if (needs_luminance(m_plan))
            m_needs.measuring = luminance_bytes(m_region) +
                                m_reference.reader.row_bytes() * kLuminanceRows +
                                m_reference.reader.bytes_while_saving();
        m_bands.plan(m_plan.common.memory, m_needs, m_region, m_roi);
        for (size_t i = 0; !m_bands.one() && i <= m_tests.size(); ++i)
            (i == 0 ? m_reference.reader : m_tests[i - 1].reader).save_memory();
    }

    // The exposures, and what is compared if it fits.
    void measure() {
        constexpr size_t usual_exposures = 16;
        const std::vector<double>& given = m_plan.evaluation.stops;
        make_bands(given.empty()
                       ? size_t(m_plan.hdr_options.num_exposures.value_or(usual_exposures))
                       : given.size());
        if (m_bands.one())
            read(m_region.ybegin, m_region.yend);
        metrics::ExposureStats stats;
        if (needs_luminance(m_plan))
            stats = measured_reference();
        m_exposures = choose_exposures(m_plan, stats);
        make_bands(m_exposures.stops.size());
        if (!m_bands.one())
            start_again();
    }

    metrics::ExposureStats measured_reference() {
        const auto luminance = of_side(m_reference.name, [&] {
            return read_luminance(m_reference.reader, m_reference.planes, m_nthreads);
        });
        const auto stats = metrics::exposure_statistics(
            luminance.data(), m_region.width(), m_region.height(), make_parallel(m_nthreads));
        check_finite(m_reference.planes, "the reference");
        return stats;
    }

    void start_again() {
        m_reference.planes = m_reference.reader.planes();
        for (size_t t = 0; t < m_tests.size(); ++t)
            m_tests[t].planes = m_fitted[t].planes(m_tests[t].reader);
    }

    // Rows of all images: of several files at the same time where memory is no matter.
    void read(int begin, int end) {
        std::vector<std::function<void()>> tasks{[=] { m_reference.read(begin, end); }};
        for (Side& test : m_tests)
            tasks.emplace_back([=, &test] { test.read(begin, end); });
        run_beside(tasks, m_bands.one() ? m_nthreads : 1);
    }

    void run_band(int begin, int end, std::vector<FlipMaps>& maps) {
        const int had = m_reference.planes.end;
        if (!m_reference.planes.whole())
            read(std::max(begin - m_radius, m_region.ybegin),
                 std::min(end + m_radius, m_region.yend));
        if (m_reference.planes.end == m_region.yend)
            check_sound();
        const int fresh = m_bands.one() ? m_region.ybegin : had;
        // A reference with non-finite pixels is changed differently for each test.
        const size_t step = m_reference.planes.counts.nonfinite > 0 ? 1 : m_tests.size();
        for (size_t t = 0; t < m_tests.size(); t += step) {
            for (size_t i = t; i < t + step; ++i)
                substitute(i, fresh);
            measure_bakes(t, step, fresh);
            if (const int from = std::max(begin, m_roi.ybegin), to = std::min(end, m_roi.yend);
                from < to)
                evaluate(t, step, from, to, maps);
            if (m_tests.size() > 1)
                fill_nonfinite(m_reference.planes, 0); // black again
        }
    }

    void substitute(size_t test, int fresh) {
        ColorPlanes &r = m_reference.planes, &t = m_tests[test].planes;
        take_reference(r, t, fresh, r.end);
        substitute_nonfinite(r, t, r.begin, fresh);
        const NonfiniteBoth both = substitute_nonfinite(r, t, fresh, r.end);
        m_both[test].alike += both.alike;
        m_both[test].unlike += both.unlike;
    }

    // How far a baked view is off, on the rows that were just read.
    void measure_bakes(size_t from, size_t count, int fresh) {
        if (!m_plan.baked() || m_plan.only_shown)
            return;
        const auto measure = [&](const ColorPlanes& planes) {
            m_exposures.bake.add(
                measure_bake(m_plan.light, planes, fresh, planes.end, m_exposures.stops));
        };
        if (from == 0)
            measure(m_reference.planes);
        for (size_t t = from; t < from + count; ++t)
            measure(m_tests[t].planes);
    }

    // Everything has been read: whether there was something to compare.
    void check_sound() const {
        double largest = m_reference.planes.counts.largest;
        for (const Side& test : m_tests) {
            check_finite(m_reference.planes, "the reference");
            check_finite(test.planes, "the test");
            largest = std::max(largest, double(test.planes.counts.largest));
        }
        check_curve(m_plan, m_exposures, largest);
    }

    void evaluate(size_t from, size_t count, int begin, int end, std::vector<FlipMaps>& maps) {
        if (m_plan.filters())
            evaluate_flip(from, count, begin, end, maps);
        for (size_t t = from; t < from + count && m_plan.pixel_error; ++t)
            evaluate_pixels(t, begin, end, maps[t]);
        for (size_t t = from; t < from + count; ++t)
            maps[t].take(begin, end, m_reference.planes, m_tests[t].planes);
    }

    void evaluate_pixels(size_t test, int begin, int end, FlipMaps& map) {
        float* const out = map.output(begin).error;
        make_parallel(m_bands.threads())(end - begin, [&](int64_t row) {
            const float *r[3], *t[3];
            m_reference.planes.row(m_roi.xbegin, begin + int(row), r);
            m_tests[test].planes.row(m_roi.xbegin, begin + int(row), t);
            metrics::error_row(*m_plan.pixel_error, m_exposures.stops, r, t,
                               out + row * m_roi.width(), m_roi.width());
        });
    }

    void evaluate_flip(size_t from, size_t count, int begin, int end, std::vector<FlipMaps>& maps) {
        flip::Evaluation evaluation = m_bands.one() ? m_plan.evaluation : bounded();
        evaluation.stops = m_exposures.stops;
        std::vector<flip::Output> outputs;
        std::vector<kernels::ConstRgb> views;
        for (size_t t = from; t < from + count; ++t) {
            views.push_back(m_tests[t].planes.view());
            outputs.push_back(maps[t].output(begin));
        }
        const kernels::Window window{m_roi.xbegin - m_region.xbegin, begin - m_region.ybegin,
                                     m_roi.width(), end - begin};
        flip::evaluate(evaluation, m_reference.planes.view(), views, window, outputs,
                       make_parallel(m_bands.threads()));
    }

    const FlipPlan& m_plan;
    const ImageBuf& m_image;
    int m_nthreads, m_radius;
    ROI m_region, m_roi;
    IgnoredPixels m_ignored;
    const FittedTest* m_fitted = nullptr;
    uint64_t m_held = 0;
    MemoryNeeds m_needs;
    Bands m_bands;
    Side m_reference;
    std::vector<Side> m_tests;
    std::vector<NonfiniteBoth> m_both;
    Exposures m_exposures;
};

} // namespace

void run_flip(const FlipPlan& plan, const ImageBuf& reference,
              const std::vector<const ImageBuf*>& tests, const std::vector<ImageBuf*>& dst, ROI roi,
              int nthreads, std::vector<ImageBuf>& maps, std::vector<FlipResult>& results) {
    maps.reserve(tests.size());
    results.reserve(tests.size());
    std::vector<FittedTest> fitted(tests.size());
    bool one_region = true;
    for (size_t t = 0; t < tests.size(); ++t) {
        fitted[t].open(reference, *tests[t], plan.common, nthreads);
        one_region = one_region && same_window(fitted[t].region(), fitted[0].region());
    }
    const size_t step = one_region ? tests.size() : 1;
    uint64_t held = 0;
    for (size_t t = 0; t < tests.size(); t += step) {
        Group group(plan, reference, nthreads);
        const std::vector<ImageBuf*> to(dst.begin() + ptrdiff_t(t),
                                        dst.begin() + ptrdiff_t(t + step));
        group.run(&fitted[t], to, roi, held, maps, results);
        held += group.map_bytes_made();
    }
}

} // namespace tonetool
