#include "imagebuf/flip_run.h"

#include <algorithm>

#include "imagebuf/flip_finish.h"
#include "imagebuf/pair.h"
#include "imagebuf/parallel.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// The tests that share one region with the reference, compared together.
class Group {
public:
    Group(const FlipPlan& plan, const ImageBuf& reference, int nthreads)
        : m_plan(plan),
          m_image(reference),
          m_nthreads(nthreads) {}

    bool run(const FittedTest* tests, size_t count, const ROI& roi, std::vector<ImageBuf>& maps,
             std::vector<FlipResult>& results, std::string& error) {
        if (!clip(roi, tests[0].region(), error) || !read(tests, count, error) ||
            !choose_exposures(m_plan, m_reference, m_image.roi(), m_nthreads, m_exposures, error))
            return false;
        double largest = m_reference.largest;
        for (const ColorPlanes& test : m_tests)
            largest = std::max(largest, double(test.largest));
        if (!check_curve(m_plan, m_exposures, largest, error))
            return false;
        if (m_reference.nonfinite_count == 0) {
            evaluate(0, count, maps, results);
            return true;
        }
        // A reference with non-finite pixels is mended differently for each test.
        const ColorPlanes as_read = m_reference;
        for (size_t t = 0; t < count; ++t) {
            m_reference = as_read;
            evaluate(t, 1, maps, results);
        }
        return true;
    }

private:
    bool clip(const ROI& roi, const ROI& region, std::string& error) {
        m_region = region;
        m_roi = roi.defined() ? OIIO::roi_intersection(roi, region) : region;
        if (m_roi.width() > 0 && m_roi.height() > 0)
            return true;
        error = "the region of interest holds no pixel of the images";
        return false;
    }

    bool read(const FittedTest* tests, size_t count, std::string& error) {
        if (!read_side(m_image, m_plan.common.pixels, m_region, m_plan.alpha(), m_nthreads,
                       "reference", m_reference, error))
            return false;
        m_tests.resize(count);
        m_fitted = tests;
        for (size_t t = 0; t < count; ++t)
            if (!tests[t].read(m_plan.alpha(), m_nthreads, m_tests[t], error) ||
                !comparable(m_tests[t], error))
                return false;
        return true;
    }

    bool comparable(const ColorPlanes& test, std::string& error) const {
        if (m_plan.alpha() && m_reference.choice.a < 0 && test.choice.a < 0) {
            error = "alpha=error, but neither image has an alpha channel";
            return false;
        }
        const auto all = int64_t(m_region.width()) * m_region.height();
        for (const ColorPlanes* side : {&m_reference, &test}) {
            const std::string who = side == &test ? "the test" : "the reference";
            if (side->uncovered_count >= all)
                error = who + "'s data window covers none of the compared pixels: there is nothing "
                              "to compare";
            else if (side->nonfinite_count + side->uncovered_count >= all)
                error = who + " has no finite pixel: there is nothing to compare";
        }
        return error.empty();
    }

    void evaluate(size_t from, size_t count, std::vector<ImageBuf>& maps,
                  std::vector<FlipResult>& results) {
        flip::Evaluation evaluation = m_plan.evaluation;
        evaluation.stops = m_exposures.stops;
        const size_t pixels = size_t(m_roi.width()) * size_t(m_roi.height());
        std::vector<FlipMaps> planes(count, FlipMaps(m_plan, pixels, evaluation.stops.size()));
        std::vector<flip::Output> outputs;
        std::vector<kernels::ConstRgb> views;
        std::vector<int64_t> both;
        for (size_t t = 0; t < count; ++t) {
            both.push_back(mend_nonfinite(m_reference, m_tests[from + t]));
            views.push_back(m_tests[from + t].view());
            outputs.push_back(planes[t].output(m_roi.width()));
        }
        const kernels::Window window{m_roi.xbegin - m_region.xbegin, m_roi.ybegin - m_region.ybegin,
                                     m_roi.width(), m_roi.height()};
        flip::evaluate(evaluation, m_reference.view(), views, window, outputs,
                       make_parallel(m_nthreads));
        for (size_t t = 0; t < count; ++t) {
            maps.emplace_back();
            results.emplace_back();
            finish({m_plan, m_exposures, m_reference, m_tests[from + t], m_roi, m_image.roi_full(),
                    both[t], m_fitted[from + t].notes(), m_nthreads},
                   planes[t], maps.back(), results.back());
        }
    }

    const FlipPlan& m_plan;
    const ImageBuf& m_image;
    int m_nthreads;
    ROI m_region, m_roi;
    ColorPlanes m_reference;
    const FittedTest* m_fitted = nullptr;
    std::vector<ColorPlanes> m_tests;
    Exposures m_exposures;
};

} // namespace

bool run_flip(const FlipPlan& plan, const ImageBuf& reference,
              const std::vector<const ImageBuf*>& tests, ROI roi, int nthreads,
              std::vector<ImageBuf>& maps, std::vector<FlipResult>& results, std::string& error) {
    std::vector<FittedTest> fitted(tests.size());
    bool one_region = true;
    for (size_t t = 0; t < tests.size(); ++t) {
        if (!fitted[t].open(reference, *tests[t], plan.common, nthreads, error))
            return false;
        one_region = one_region && same_window(fitted[t].region(), fitted[0].region());
    }
    if (one_region)
        return Group(plan, reference, nthreads)
            .run(fitted.data(), fitted.size(), roi, maps, results, error);
    for (const FittedTest& test : fitted)
        if (!Group(plan, reference, nthreads).run(&test, 1, roi, maps, results, error))
            return false;
    return true;
}

} // namespace tonetool
