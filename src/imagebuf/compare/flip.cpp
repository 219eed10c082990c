// SPDX-License-Identifier: BSD-3-Clause
// The public functions of include/tonetool/flip.h.
#include "tonetool/flip.h"

#include <algorithm>
#include <utility>

#include "imagebuf/compare/flip_run.h"
#include "imagebuf/pixels/deliver.h"
#include "imagebuf/pixels/guard.h"
#include "metrics/refusal.h"
#include "tonemap/curves.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// One test: `make_plan()` turns the options into numbers.
template <class MakePlan>
bool compare(const char* function, ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
             FlipResult* result, ROI roi, int nthreads, const MakePlan& make_plan) {
    return guarded(dst, function, [&] {
        const FlipPlan plan = make_plan();
        std::vector<ImageBuf> maps;
        std::vector<FlipResult> results;
        run_flip(plan, reference, {&test}, {&dst}, roi, nthreads, maps, results);
        deliver(dst, std::move(maps[0]), "FLIP:");
        if (result)
            *result = std::move(results[0]);
    });
}

void compare_all(std::vector<ImageBuf>& dst, const ImageBuf& reference,
                 const std::vector<const ImageBuf*>& tests, const HdrFlipOptions& options,
                 std::vector<FlipResult>* results, ROI roi, int nthreads) {
    std::vector<ImageBuf> maps;
    std::vector<FlipResult> found;
    if (tests.empty() || std::count(tests.begin(), tests.end(), nullptr) > 0)
        throw Refusal(tests.empty() ? "there is no test image" : "a test image is a null pointer");
    dst.resize(tests.size());
    std::vector<ImageBuf*> to;
    for (ImageBuf& map : dst)
        to.push_back(&map);
    run_flip(plan_hdr(options), reference, tests, to, roi, nthreads, maps, found);
    for (size_t t = 0; t < tests.size(); ++t)
        deliver(dst[t], std::move(maps[t]), "FLIP:");
    if (results)
        *results = std::move(found);
}

} // namespace

namespace ToneAlgo {

bool ldr_flip(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
              const FlipOptions& options, FlipResult* result, ROI roi, int nthreads) {
    return compare("ldr_flip", dst, reference, test, result, roi, nthreads,
                   [&] { return plan_ldr(options); });
}

ImageBuf ldr_flip(const ImageBuf& reference, const ImageBuf& test, const FlipOptions& options,
                  FlipResult* result, ROI roi, int nthreads) {
    ImageBuf dst;
    ldr_flip(dst, reference, test, options, result, roi, nthreads);
    return dst;
}

bool hdr_flip(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
              const HdrFlipOptions& options, FlipResult* result, ROI roi, int nthreads) {
    return compare("hdr_flip", dst, reference, test, result, roi, nthreads,
                   [&] { return plan_hdr(options); });
}

ImageBuf hdr_flip(const ImageBuf& reference, const ImageBuf& test, const HdrFlipOptions& options,
                  FlipResult* result, ROI roi, int nthreads) {
    ImageBuf dst;
    hdr_flip(dst, reference, test, options, result, roi, nthreads);
    return dst;
}

bool hdr_flip(std::vector<ImageBuf>& dst, const ImageBuf& reference,
              const std::vector<const ImageBuf*>& tests, const HdrFlipOptions& options,
              std::vector<FlipResult>* results, ROI roi, int nthreads) {
    std::string error;
    if (contained(error,
                  [&] { compare_all(dst, reference, tests, options, results, roi, nthreads); }))
        return true;
    dst.assign(std::max<size_t>(tests.size(), 1), ImageBuf());
    for (ImageBuf& map : dst)
        map.errorfmt("hdr_flip: {}", error);
    return false;
}

bool flip_exposed(std::vector<FlipExposure>& dst, const ImageBuf& reference, const ImageBuf& test,
                  std::string& error, const HdrFlipOptions& options,
                  const std::vector<double>& stops, ROI roi, int nthreads) {
    dst.clear();
    return contained(error, [&] {
        ImageBuf unused;
        std::vector<ImageBuf> maps;
        std::vector<FlipResult> results;
        run_flip(plan_shown(options, stops), reference, {&test}, {&unused}, roi, nthreads, maps,
                 results);
        dst = std::move(results[0].exposures);
    });
}

std::vector<std::string> flip_tonemappers() {
    return tonemap::curve_names();
}

} // namespace ToneAlgo
} // namespace tonetool
