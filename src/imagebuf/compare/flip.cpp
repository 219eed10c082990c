// The public functions of include/tonetool/flip.h.
#include "tonetool/flip.h"

#include <algorithm>
#include <utility>

#include "imagebuf/compare/flip_run.h"
#include "imagebuf/pixels/deliver.h"
#include "imagebuf/pixels/guard.h"
#include "tonemap/curves.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// One test: `make_plan(plan, error)` turns the options into numbers.
template <class MakePlan>
bool compare(const char* function, ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
             FlipResult* result, ROI roi, int nthreads, const MakePlan& make_plan) {
    return guarded(dst, function, [&](std::string& error) {
        FlipPlan plan;
        std::vector<ImageBuf> maps;
        std::vector<FlipResult> results;
        if (!make_plan(plan, error) ||
            !run_flip(plan, reference, {&test}, {&dst}, roi, nthreads, maps, results, error))
            return false;
        deliver(dst, std::move(maps[0]), "FLIP:");
        if (result)
            *result = std::move(results[0]);
        return true;
    });
}

bool compare_all(std::vector<ImageBuf>& dst, const ImageBuf& reference,
                 const std::vector<const ImageBuf*>& tests, const HdrFlipOptions& options,
                 std::vector<FlipResult>* results, ROI roi, int nthreads, std::string& error) {
    FlipPlan plan;
    std::vector<ImageBuf> maps;
    std::vector<FlipResult> found;
    if (tests.empty() || std::count(tests.begin(), tests.end(), nullptr) > 0) {
        error = tests.empty() ? "there is no test image" : "a test image is a null pointer";
        return false;
    }
    dst.resize(tests.size());
    std::vector<ImageBuf*> to;
    for (ImageBuf& map : dst)
        to.push_back(&map);
    if (!plan_hdr(options, plan, error) ||
        !run_flip(plan, reference, tests, to, roi, nthreads, maps, found, error))
        return false;
    for (size_t t = 0; t < tests.size(); ++t)
        deliver(dst[t], std::move(maps[t]), "FLIP:");
    if (results)
        *results = std::move(found);
    return true;
}

} // namespace

namespace ToneAlgo {

bool ldr_flip(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
              const FlipOptions& options, FlipResult* result, ROI roi, int nthreads) {
    return compare(
        "ldr_flip", dst, reference, test, result, roi, nthreads,
        [&](FlipPlan& plan, std::string& error) { return plan_ldr(options, plan, error); });
}

ImageBuf ldr_flip(const ImageBuf& reference, const ImageBuf& test, const FlipOptions& options,
                  FlipResult* result, ROI roi, int nthreads) {
    ImageBuf dst;
    ldr_flip(dst, reference, test, options, result, roi, nthreads);
    return dst;
}

bool hdr_flip(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
              const HdrFlipOptions& options, FlipResult* result, ROI roi, int nthreads) {
    return compare(
        "hdr_flip", dst, reference, test, result, roi, nthreads,
        [&](FlipPlan& plan, std::string& error) { return plan_hdr(options, plan, error); });
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
    if (contained(error, [&](std::string& why) {
            return compare_all(dst, reference, tests, options, results, roi, nthreads, why);
        }))
        return true;
    dst.assign(std::max<size_t>(tests.size(), 1), ImageBuf());
    for (ImageBuf& map : dst)
        map.errorfmt("hdr_flip: {}", error);
    return false;
}

std::vector<std::string> flip_tonemappers() {
    return tonemap::curve_names();
}

} // namespace ToneAlgo
} // namespace tonetool
