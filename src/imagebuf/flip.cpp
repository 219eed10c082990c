// The public functions of include/tonetool/flip.h.
#include "include/tonetool/flip.h"

#include <exception>
#include <utility>

#include "imagebuf/flip_run.h"
#include "tonemap/rational.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// An image the caller prepared takes the map's pixels in place; any other becomes the map.
void deliver(ImageBuf& dst, ImageBuf&& map) {
    const bool in_place = dst.initialized() && dst.nchannels() == 1 &&
                          dst.pixeltype() == OIIO::TypeFloat && dst.localpixels() &&
                          dst.roi().contains(map.roi());
    if (!in_place) {
        dst = std::move(map);
        return;
    }
    dst.set_pixels(map.roi(), OIIO::TypeFloat, map.localpixels());
    for (const auto& attribute : map.spec().extra_attribs)
        if (attribute.name().find("FLIP:") == 0)
            dst.specmod().attribute(attribute.name(), attribute.type(), attribute.data());
}

bool fail(ImageBuf& dst, const char* function, const std::string& why) {
    dst.clear();
    dst.errorfmt("{}: {}", function, why);
    return false;
}

// Runs, keeping every exception inside.
bool guarded_run(const FlipPlan& plan, const ImageBuf& reference,
                 const std::vector<const ImageBuf*>& tests, ROI roi, int nthreads,
                 std::vector<ImageBuf>& maps, std::vector<FlipResult>& results,
                 std::string& error) {
    try {
        return run_flip(plan, reference, tests, roi, nthreads, maps, results, error);
    } catch (const std::bad_alloc&) {
        error = "not enough memory";
    } catch (const std::exception& e) {
        error = e.what();
    }
    return false;
}

bool run_one(const char* function, bool planned, const FlipPlan& plan, std::string& error,
             ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test, FlipResult* result,
             ROI roi, int nthreads) {
    std::vector<ImageBuf> maps;
    std::vector<FlipResult> results;
    if (!planned || !guarded_run(plan, reference, {&test}, roi, nthreads, maps, results, error))
        return fail(dst, function, error);
    deliver(dst, std::move(maps[0]));
    if (result)
        *result = std::move(results[0]);
    return true;
}

} // namespace

namespace ToneAlgo {

bool ldr_flip(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
              const FlipOptions& options, FlipResult* result, ROI roi, int nthreads) {
    FlipPlan plan;
    std::string error;
    const bool planned = plan_ldr(options, plan, error);
    return run_one("ldr_flip", planned, plan, error, dst, reference, test, result, roi, nthreads);
}

ImageBuf ldr_flip(const ImageBuf& reference, const ImageBuf& test, const FlipOptions& options,
                  FlipResult* result, ROI roi, int nthreads) {
    ImageBuf dst;
    ldr_flip(dst, reference, test, options, result, roi, nthreads);
    return dst;
}

bool hdr_flip(ImageBuf& dst, const ImageBuf& reference, const ImageBuf& test,
              const HdrFlipOptions& options, FlipResult* result, ROI roi, int nthreads) {
    FlipPlan plan;
    std::string error;
    const bool planned = plan_hdr(options, plan, error);
    return run_one("hdr_flip", planned, plan, error, dst, reference, test, result, roi, nthreads);
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
    FlipPlan plan;
    std::string error;
    std::vector<ImageBuf> maps;
    std::vector<FlipResult> found;
    dst.resize(tests.size());
    if (tests.empty() || !plan_hdr(options, plan, error) ||
        !guarded_run(plan, reference, tests, roi, nthreads, maps, found, error)) {
        for (ImageBuf& map : dst)
            fail(map, "hdr_flip", error);
        return false;
    }
    for (size_t t = 0; t < tests.size(); ++t)
        deliver(dst[t], std::move(maps[t]));
    if (results)
        *results = std::move(found);
    return true;
}

std::vector<std::string> flip_tonemappers() {
    return tonemap::rational_curve_names();
}

namespace {

struct Quantity {
    const char* name;
    double FlipPool::*value;
};

constexpr Quantity kQuantities[] = {{"mean", &FlipPool::mean},
                                    {"weighted-median", &FlipPool::weighted_median},
                                    {"weighted-q1", &FlipPool::weighted_q1},
                                    {"weighted-q3", &FlipPool::weighted_q3},
                                    {"p50", &FlipPool::p50},
                                    {"p95", &FlipPool::p95},
                                    {"p99", &FlipPool::p99},
                                    {"p99.9", &FlipPool::p999},
                                    {"min", &FlipPool::min},
                                    {"max", &FlipPool::max}};

} // namespace

std::optional<double> flip_quantity(const FlipPool& pool, const std::string& name) {
    for (const Quantity& q : kQuantities)
        if (name == q.name)
            return pool.*q.value;
    return std::nullopt;
}

std::vector<std::string> flip_quantities() {
    std::vector<std::string> names;
    for (const Quantity& q : kQuantities)
        names.emplace_back(q.name);
    return names;
}

} // namespace ToneAlgo
} // namespace tonetool
