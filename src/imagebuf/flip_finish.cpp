#include "imagebuf/flip_finish.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/annotate.h"
#include "imagebuf/parallel.h"
#include "kernels/flip_tile.h"
#include "metrics/pooling.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// Calls visit(index in the planes of the region, index in the maps, x, y) for every pixel.
template <class F>
void for_each_pixel(const Compared& c, const F& visit) {
    const ROI& region = c.reference.region;
    size_t at = 0;
    for (int y = c.roi.ybegin; y < c.roi.yend; ++y)
        for (int x = c.roi.xbegin; x < c.roi.xend; ++x, ++at)
            visit(size_t(y - region.ybegin) * size_t(region.width()) + size_t(x - region.xbegin),
                  at, x, y);
}

size_t pixels_of(const ROI& r) {
    return size_t(r.width()) * size_t(r.height());
}

// `channels` interleaved floats per pixel of `roi` as an image.
ImageBuf make_image(const Compared& c, int channels, const float* pixels) {
    OIIO::ImageSpec spec(c.roi.width(), c.roi.height(), channels, OIIO::TypeFloat);
    spec.x = c.roi.xbegin;
    spec.y = c.roi.ybegin;
    spec.full_x = c.full.xbegin;
    spec.full_y = c.full.ybegin;
    spec.full_width = c.full.width();
    spec.full_height = c.full.height();
    ImageBuf image(spec);
    image.set_pixels(image.roi(), OIIO::TypeFloat, pixels);
    return image;
}

void compare_alpha(const Compared& c, FlipMaps& maps, FlipSummary& s) {
    s.alpha_compared = true;
    double sum = 0;
    for_each_pixel(c, [&](size_t i, size_t at, int x, int y) {
        if (c.reference.nonfinite[i] || c.test.nonfinite[i])
            return;
        const double difference = std::abs(double(c.reference.alpha[i]) - c.test.alpha[i]);
        sum += difference;
        if (difference > s.alpha_max) {
            s.alpha_max = difference;
            s.alpha_max_x = x;
            s.alpha_max_y = y;
        }
        maps.error[at] = std::max(maps.error[at], float(difference));
    });
    s.alpha_mean = sum / double(pixels_of(c.roi));
}

// Error 1 where one image alone is non-finite, 0 where both are.
void override_nonfinite(const Compared& c, FlipMaps& maps) {
    if (c.reference.nonfinite_count == 0 && c.test.nonfinite_count == 0)
        return;
    for_each_pixel(c, [&](size_t i, size_t at, int, int) {
        const bool r = c.reference.nonfinite[i], t = c.test.nonfinite[i];
        if (!r && !t)
            return;
        maps.error[at] = r != t ? 1.0f : 0.0f;
        if (!maps.index.empty())
            maps.index[at] = 0;
        for (auto& plane : maps.per_exposure)
            plane[at] = maps.error[at];
    });
}

FlipSide side_of(const ColorPlanes& planes) {
    return {planes.choice.layer, planes.choice.space, planes.nonfinite_count, planes.negative_count,
            planes.uncovered_count};
}

void collect_warnings(const Compared& c, FlipSummary& s) {
    s.warnings = c.notes;
    const auto say = [&s](int64_t n, const char* what) {
        if (n > 0)
            s.warnings.push_back(std::to_string(n) + " " + what);
    };
    say(s.reference.nonfinite, "pixel(s) of the reference are NaN or Inf");
    say(s.test.nonfinite, "pixel(s) of the test are NaN or Inf");
    say(s.nonfinite_both, "pixel(s) are NaN or Inf in both images and count as equal");
    say(s.reference.uncovered, "compared pixel(s) lie outside the reference's data window");
    say(s.test.uncovered, "compared pixel(s) lie outside the test's data window");
    if (s.median_of_lit)
        s.warnings.push_back(OIIO::Strutil::fmt::format(
            "more than half of the reference is black: the stop exposure follows the median "
            "{:.6g} of the lit pixels",
            s.median_luminance));
    if (s.alpha_compared && (c.reference.choice.a < 0 || c.test.choice.a < 0))
        s.warnings.emplace_back("only one image has alpha: the other counts as opaque");
}

// Images that differ although nothing shows must not look like equal ones.
void warn_of_unseen(const Compared& c, FlipSummary& s) {
    constexpr double nothing_shows = 1e-6;
    if (s.pool.max > nothing_shows)
        return;
    int64_t differing = 0;
    for_each_pixel(c, [&](size_t i, size_t, int, int) {
        bool differs = false;
        for (size_t p = 0; p < 3; ++p)
            differs = differs || c.reference.plane[p][i] != c.test.plane[p][i];
        differing += differs;
    });
    if (differing > 0)
        s.warnings.push_back(std::to_string(differing) +
                             " pixel(s) differ, but none shows at the exposures compared");
    if (c.reference.negative_digest != c.test.negative_digest)
        s.warnings.emplace_back("the images differ in negative values, which count as 0");
}

FlipSummary summarize(const Compared& c, FlipMaps& maps) {
    FlipSummary s;
    s.hdr = c.plan.hdr;
    s.ppd = c.plan.ppd;
    s.region = c.roi;
    s.reference = side_of(c.reference);
    s.test = side_of(c.test);
    s.nonfinite_both = c.nonfinite_both;
    if (c.plan.hdr) {
        s.tonemapper = c.plan.tonemapper;
        s.coeffs.assign(c.plan.evaluation.curve.k.begin(), c.plan.evaluation.curve.k.end());
        s.exposures = c.exposures.stops;
        s.max_luminance = c.exposures.max_luminance;
        s.median_luminance = c.exposures.median_luminance;
        s.median_of_lit = c.exposures.median_of_lit;
    }
    if (c.plan.alpha())
        compare_alpha(c, maps, s);
    override_nonfinite(c, maps);
    s.pool = metrics::pool(maps.error.data(), c.roi.width(), c.roi.height(), c.roi.width(),
                           c.roi.xbegin, c.roi.ybegin, make_parallel(c.nthreads));
    collect_warnings(c, s);
    warn_of_unseen(c, s);
    return s;
}

// What the comparison saw of one image at one exposure.
ImageBuf tone_mapped(const Compared& c, const ColorPlanes& planes, double stops) {
    std::vector<float> mapped[3];
    const float* in[3];
    float* out[3];
    for (int p = 0; p < 3; ++p) {
        mapped[p].resize(planes.plane[p].size());
        in[p] = planes.plane[p].data();
        out[p] = mapped[p].data();
    }
    kernels::tone_map_pixels(in, out, ptrdiff_t(mapped[0].size()), c.plan.evaluation.curve,
                             float(std::exp2(stops)));
    std::vector<float> pixels(pixels_of(c.roi) * 3);
    for_each_pixel(c, [&](size_t i, size_t at, int, int) {
        for (size_t p = 0; p < 3; ++p)
            pixels[at * 3 + p] = mapped[p][i];
    });
    ImageBuf image = make_image(c, 3, pixels.data());
    image.specmod().attribute("oiio:ColorSpace", "Linear");
    return image;
}

void keep_exposure_maps(const Compared& c, const FlipMaps& maps, FlipResult& result) {
    std::vector<float> stops(maps.index.size());
    for (size_t i = 0; i < stops.size(); ++i)
        stops[i] = float(c.exposures.stops[size_t(maps.index[i])]);
    result.exposure_index = make_image(c, 1, maps.index.data());
    result.exposure_stops = make_image(c, 1, stops.data());
}

} // namespace

FlipMaps::FlipMaps(const FlipPlan& plan, size_t pixels, size_t exposures)
    : error(pixels),
      index(plan.hdr && plan.hdr_options.want_exposure_map ? pixels : 0),
      per_exposure(plan.hdr && plan.hdr_options.want_exposures ? exposures : 0,
                   std::vector<float>(pixels)) {}

flip::Output FlipMaps::output(int width) {
    flip::Output out;
    out.error = error.data();
    out.index = index.empty() ? nullptr : index.data();
    for (auto& plane : per_exposure)
        out.per_exposure.push_back(plane.data());
    out.stride = width;
    return out;
}

void finish(const Compared& c, FlipMaps& maps, ImageBuf& map, FlipResult& result) {
    result.summary = summarize(c, maps);
    map = make_image(c, 1, maps.error.data());
    annotate(map.specmod(), result.summary);
    if (!maps.index.empty())
        keep_exposure_maps(c, maps, result);
    for (size_t n = 0; n < maps.per_exposure.size(); ++n) {
        const double stops = c.exposures.stops[n];
        result.exposures.push_back({stops, tone_mapped(c, c.reference, stops),
                                    tone_mapped(c, c.test, stops),
                                    make_image(c, 1, maps.per_exposure[n].data())});
    }
}

} // namespace tonetool
