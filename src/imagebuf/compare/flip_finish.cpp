// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/compare/flip_finish.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "imagebuf/compare/annotate.h"
#include "imagebuf/compare/pair.h"
#include "imagebuf/compare/quantities.h"
#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/deliver.h"
#include "imagebuf/pixels/ignored_pixels.h"
#include "imagebuf/pixels/parallel.h"
#include "kernels/flip_tile.h"
#include "metrics/pooling.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

void collect_warnings(const ColorPlanes& reference, const ColorPlanes& test, FlipSummary& s) {
    warn_of_holes(s.reference, "the reference", s.warnings);
    warn_of_holes(s.test, "the test", s.warnings);
    if (s.nonfinite_both > 0)
        s.warnings.push_back(std::to_string(s.nonfinite_both) +
                             " pixel(s) are NaN or Inf in both images and count as equal");
    if (s.nonfinite_unlike > 0)
        s.warnings.push_back(std::to_string(s.nonfinite_unlike) +
                             " pixel(s) are NaN or Inf in both images, but of another kind or "
                             "beside other values: they count as different");
    if (s.alpha_ignored > 0)
        s.warnings.push_back(std::to_string(s.alpha_ignored) +
                             " pixel(s) differ in alpha, which is ignored (alpha=error compares "
                             "it)");
    if (s.median_of_lit)
        s.warnings.push_back(OIIO::Strutil::fmt::format(
            "more than half of the reference is black: the stop exposure follows the median "
            "{:.6g} of the lit pixels",
            s.median_luminance));
    if (s.alpha_compared && (reference.choice.a < 0 || test.choice.a < 0))
        s.warnings.emplace_back("only one image has alpha: the other counts as opaque");
}

// Display light that an 8-bit sRGB picture stores as 255, and as 0.
constexpr float kWhite = 0.9956f, kBlack = 0.5f / 255 / 12.92f;

// Marks the largest error while it is not known yet: below every error.
constexpr float kLargest = -1;

} // namespace

size_t map_bytes(const FlipPlan& plan, size_t exposures) {
    size_t planes = plan.only_shown ? 0 : 1;
    if (plan.hdr && plan.hdr_options.want_exposure_map)
        planes += 2;
    if (plan.hdr && plan.hdr_options.want_exposures)
        planes += (plan.only_shown ? 6 : 7) * exposures;
    return planes * sizeof(float);
}

FlipMaps::FlipMaps(const FlipPlan& plan, const Exposures& exposures, const ROI& roi,
                   const ROI& full, ImageBuf& dst, int nthreads)
    : m_plan(plan),
      m_exposures(exposures),
      m_roi(roi),
      m_full(full),
      m_nthreads(nthreads),
      m_unbounded(plan.pixel_error && !plan.pixel_error->bounded()),
      m_error(make_image(1)),
      m_alpha(plan.alpha() ? size_t(roi.height()) : 0) {
    const auto stride = OIIO::stride_t(sizeof(float)) * roi.width();
    if (takes_map(dst, roi) && dst.scanline_stride() == stride) { // it is computed in place
        const OIIO::ImageSpec spec = m_error.spec();
        m_error = ImageBuf(spec, dst.pixeladdr(roi.xbegin, roi.ybegin));
    }
    if (plan.hdr && plan.hdr_options.want_exposure_map)
        m_index = make_image(1);
    // A vector that grows copies the pixels of its ImageBufs.
    m_pictures.reserve(exposures.stops.size());
    if (plan.hdr && plan.hdr_options.want_exposures)
        for (double stops : exposures.stops)
            m_pictures.push_back({stops, make_image(3), make_image(3),
                                  plan.only_shown ? ImageBuf() : make_image(1)});
    for (FlipExposure& picture : m_pictures)
        for (ImageBuf* image : {&picture.reference, &picture.test})
            image->specmod().attribute("oiio:ColorSpace", "Linear");
    m_clipping = clipping();
}

// An image of the roi; its memory is not touched yet.
ImageBuf FlipMaps::make_image(int channels) const {
    OIIO::ImageSpec spec(m_roi.width(), m_roi.height(), channels, OIIO::TypeFloat);
    spec.x = m_roi.xbegin;
    spec.y = m_roi.ybegin;
    spec.full_x = m_full.xbegin;
    spec.full_y = m_full.ybegin;
    spec.full_width = m_full.width();
    spec.full_height = m_full.height();
    return allocated_image(spec);
}

float* FlipMaps::row(ImageBuf& image, int y) const {
    return static_cast<float*>(image.localpixels()) +
           size_t(y - m_roi.ybegin) * size_t(m_roi.width()) * size_t(image.nchannels());
}

flip::Output FlipMaps::output(int y) {
    flip::Output out;
    out.error = row(m_error, y);
    out.index = m_index.initialized() ? row(m_index, y) : nullptr;
    for (FlipExposure& picture : m_pictures)
        out.per_exposure.push_back(row(picture.flip, y));
    out.stride = m_roi.width();
    return out;
}

void FlipMaps::take(int begin, int end, const ColorPlanes& reference, const ColorPlanes& test) {
    const Sides sides{reference, test};
    const bool nonfinite = reference.counts.nonfinite > 0 || test.counts.nonfinite > 0;
    std::mutex lock;
    make_parallel(m_nthreads)(end - begin, [&](int64_t i) {
        const int y = begin + int(i);
        for (FlipExposure& picture : m_pictures) {
            tone_map_row(y, picture.stops, reference, picture.reference);
            tone_map_row(y, picture.stops, test, picture.test);
        }
        if (m_plan.only_shown)
            return;
        if (m_plan.alpha())
            compare_alpha(y, sides);
        const Lost lost = nonfinite ? override_nonfinite(y, sides) : Lost();
        if (reference.ignored)
            clear_ignored(y, *reference.ignored);
        const Unseen found = unseen(y, sides);
        const std::lock_guard<std::mutex> hold(lock);
        m_unseen.differing += found.differing;
        m_unseen.white += found.white;
        m_unseen.black += found.black;
        if (lost.count > 0 && (m_lost == 0 || y < m_lost_y)) {
            m_lost_x = lost.x;
            m_lost_y = y;
        }
        m_lost += lost.count;
    });
}

void FlipMaps::compare_alpha(int y, const Sides& sides) {
    const size_t at = sides.reference.at(y) + size_t(m_roi.xbegin - sides.reference.region.xbegin);
    float* error = row(m_error, y);
    AlphaRow& found = m_alpha[size_t(y - m_roi.ybegin)];
    for (size_t x = 0; x < size_t(m_roi.width()); ++x) {
        if (sides.reference.nonfinite[at + x] || sides.test.nonfinite[at + x])
            continue;
        const double difference =
            std::abs(double(sides.reference.alpha[at + x]) - sides.test.alpha[at + x]);
        found.sum += difference;
        if (difference > found.max) {
            found.max = difference;
            found.max_x = m_roi.xbegin + int(x);
        }
        error[x] = std::max(error[x], float(difference));
    }
}

// The largest error where one image alone is non-finite or both are in another way, else 0.
FlipMaps::Lost FlipMaps::override_nonfinite(int y, const Sides& sides) {
    const IgnoredPixels* const ignored = sides.reference.ignored;
    Lost lost;
    const size_t at = sides.reference.at(y) + size_t(m_roi.xbegin - sides.reference.region.xbegin);
    for (size_t x = 0; x < size_t(m_roi.width()); ++x) {
        const bool r = sides.reference.nonfinite[at + x], t = sides.test.nonfinite[at + x];
        if (!r && !t)
            continue;
        const bool alike = r && t && nonfinite_alike(sides.reference, at + x, sides.test, at + x);
        const float error = alike ? 0.0f : m_unbounded ? kLargest : 1.0f;
        row(m_error, y)[x] = error;
        if (m_index.initialized())
            row(m_index, y)[x] = 0;
        for (FlipExposure& picture : m_pictures)
            row(picture.flip, y)[x] = error;
        if (!r && !(ignored && ignored->at(m_roi.xbegin + int(x), y))) {
            lost.x = lost.count == 0 ? m_roi.xbegin + int(x) : lost.x;
            ++lost.count;
        }
    }
    return lost;
}

void FlipMaps::clear_ignored(int y, const IgnoredPixels& ignored) {
    for (int x = m_roi.xbegin; x < m_roi.xend; ++x) {
        if (!ignored.at(x, y))
            continue;
        const auto at = size_t(x - m_roi.xbegin);
        row(m_error, y)[at] = 0;
        if (m_index.initialized())
            row(m_index, y)[at] = 0;
        for (FlipExposure& picture : m_pictures)
            row(picture.flip, y)[at] = 0;
    }
}

void FlipMaps::mark_ignored(const IgnoredPixels& ignored, float value) {
    make_parallel(m_nthreads)(m_roi.height(), [&](int64_t i) {
        const int y = m_roi.ybegin + int(i);
        float* error = row(m_error, y);
        for (int x = m_roi.xbegin; x < m_roi.xend; ++x)
            if (ignored.at(x, y))
                error[x - m_roi.xbegin] = value;
    });
}

// Pixels that the test alone has lost have no error that anything bounds: the numbers that stand
// for them in the map are not theirs, and all infinite errors come behind the others.
void FlipMaps::pool_lost(FlipPool& pool, metrics::PoolRequest& further) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const double lost = double(m_lost) / double(pool.pixels);
    for (size_t i = 0; i < further.above.size(); ++i)
        if (further.above[i] >= pool.max) // which stands for them
            further.found_above[i] += lost;
    const auto lose = [&](double share, double& value) {
        value = share > 1 - lost ? infinite : value;
    };
    lose(0.5, pool.p50);
    lose(0.95, pool.p95);
    lose(0.99, pool.p99);
    lose(0.999, pool.p999);
    for (size_t i = 0; i < further.percentiles.size(); ++i)
        lose(further.percentiles[i] / 100, further.found_percentiles[i]);
    pool.mean = pool.weighted_q1 = pool.weighted_median = pool.weighted_q3 = infinite;
    pool.max = infinite;
    pool.max_x = m_lost_x;
    pool.max_y = m_lost_y;
}

// Where pixels do not count the map has gaps while it is pooled.
FlipPool FlipMaps::pooled(const IgnoredPixels* ignored) {
    using metrics::Gaps;
    metrics::PoolRequest further = m_plan.pool;
    if (ignored)
        mark_ignored(*ignored, std::numeric_limits<float>::quiet_NaN());
    FlipPool pool = metrics::pool(
        row(m_error, m_roi.ybegin), m_roi.width(), m_roi.height(), m_roi.width(), m_roi.xbegin,
        m_roi.ybegin, make_parallel(m_nthreads), &further, ignored ? Gaps::Nan : Gaps::None);
    if (ignored)
        mark_ignored(*ignored, 0);
    if (m_unbounded && m_lost > 0)
        pool_lost(pool, further);
    name_further(further, pool);
    return pool;
}

// Scene values that all that is white at the darkest exposure reaches, and all that is black at the
// brightest stays below; where a curve mixes the components, every value does.
FlipMaps::Clipping FlipMaps::clipping() const {
    constexpr double nearly_white = 0.99, nearly_black = 0.01;
    const double dark = std::exp2(m_exposures.stops.front());
    const double bright = std::exp2(m_exposures.stops.back());
    const bool curved = m_plan.hdr && !m_plan.pixel_error;
    if (!curved)
        return {float(nearly_white / dark), float(nearly_black / bright)};
    if (m_plan.hdr_options.view || m_plan.curve.on != "rgb" || !m_plan.bright)
        return {};
    return {float(*m_plan.bright / dark), float(nearly_black / bright)};
}

FlipMaps::Unseen FlipMaps::unseen(int y, const Sides& sides) const {
    const float *r[3], *t[3];
    sides.reference.row(m_roi.xbegin, y, r);
    sides.test.row(m_roi.xbegin, y, t);
    std::vector<float> candidates[2][3]; // of the reference and of the test
    Unseen found;
    for (int x = 0; x < m_roi.width(); ++x) {
        bool differs = false, clipped = true;
        for (size_t p = 0; p < 3; ++p) {
            const float a = r[p][x], b = t[p][x];
            differs = differs || a != b;
            clipped = clipped && (a == b || std::min(a, b) >= m_clipping.white ||
                                  std::max(a, b) < m_clipping.black);
        }
        found.differing += differs;
        for (size_t p = 0; p < 3 && differs && clipped; ++p) {
            candidates[0][p].push_back(r[p][x]);
            candidates[1][p].push_back(t[p][x]);
        }
    }
    const bool clips = m_plan.hdr || !m_plan.pixel_error; // other errors have no white
    if (clips && !candidates[0][0].empty())
        count_hidden(candidates, found);
    return found;
}

// Pixels of both images whose difference neither the darkest nor the brightest exposure shows.
void FlipMaps::count_hidden(const std::vector<float> (&pixels)[2][3], Unseen& found) const {
    const size_t count = pixels[0][0].size();
    std::vector<float> dark[2][3], bright[2][3];
    for (size_t side = 0; side < 2; ++side) {
        const auto& of = pixels[side];
        show({of[0].data(), of[1].data(), of[2].data()}, count, m_exposures.stops.front(),
             dark[side]);
        show({of[0].data(), of[1].data(), of[2].data()}, count, m_exposures.stops.back(),
             bright[side]);
    }
    for (size_t i = 0; i < count; ++i) {
        bool white = false, hidden = true;
        for (size_t p = 0; p < 3; ++p) {
            const float a = dark[0][p][i], b = dark[1][p][i];
            const float c = bright[0][p][i], d = bright[1][p][i];
            const bool both_white = std::min(a, b) >= kWhite;
            white = white || both_white;
            hidden = hidden && (both_white || std::max(c, d) < kBlack || (a == b && c == d));
        }
        if (hidden)
            ++(white ? found.white : found.black);
    }
}

// Pixels as the comparison sees them at an exposure: display light.
void FlipMaps::show(const float* const (&in)[3], size_t count, double stops,
                    std::vector<float> (&out)[3]) const {
    float* to[3];
    for (size_t p = 0; p < 3; ++p) {
        out[p].resize(count);
        to[p] = out[p].data();
    }
    const auto scale = float(std::exp2(stops));
    if (!m_plan.hdr || m_plan.pixel_error) // clamped only, or shown through a power of 2.2
        for (size_t p = 0; p < 3; ++p)
            std::transform(in[p], in[p] + count, to[p],
                           [&](float v) { return std::min(v * scale, 1.0f); });
    else if (m_plan.evaluation.rows)
        m_plan.evaluation.rows(in, to, ptrdiff_t(count), scale);
    else
        kernels::tone_map_pixels(in, to, ptrdiff_t(count), m_plan.evaluation.curve, scale);
}

// What the comparison saw of one image at one exposure.
void FlipMaps::tone_map_row(int y, double stops, const ColorPlanes& planes, ImageBuf& image) const {
    const auto width = size_t(m_roi.width());
    std::vector<float> out[3];
    const float* in[3];
    planes.row(m_roi.xbegin, y, in);
    show({in[0], in[1], in[2]}, width, stops, out);
    float* pixels = row(image, y);
    for (size_t x = 0; x < width; ++x)
        for (size_t p = 0; p < 3; ++p)
            pixels[x * 3 + p] = out[p][x];
}

// Images that differ although nothing shows must not look like equal ones.
void FlipMaps::warn_of_unseen(const Sides& sides, FlipSummary& s) const {
    const double nothing_shows = m_plan.pixel_error ? 0 : 1e-6;
    if (s.pool.max > nothing_shows)
        return;
    if (m_unseen.differing > 0)
        s.warnings.push_back(std::to_string(m_unseen.differing) + " pixel(s) differ, but " +
                             (m_plan.hdr || !m_plan.pixel_error
                                  ? "none shows at the exposures compared"
                                  : "by too little for the map's floats"));
    if (sides.reference.counts.negative_digest != sides.test.counts.negative_digest)
        s.warnings.emplace_back("the images differ in negative values, which count as 0");
}

// Where white meets white no difference shows, however large it is.
void FlipMaps::warn_of_clipped(FlipSummary& s) const {
    constexpr double share = 0.01;
    const auto warn = [&](int64_t count, const char* color, const char* cure) {
        if (double(count) > share * double(m_unseen.differing))
            s.warnings.push_back(OIIO::Strutil::fmt::format(
                "{} of {} differing pixel(s) are {} in both images at every exposure: their "
                "difference does not show ({})",
                count, m_unseen.differing, color, cure));
    };
    const bool hdr = m_plan.hdr;
    warn(m_unseen.white, "white", hdr ? "a lower startExposure shows it" : "hdrflip shows it");
    warn(m_unseen.black, "black", hdr ? "a higher stopExposure shows it" : "hdrflip shows it");
}

FlipSummary FlipMaps::summarize(const Sides& sides, const Found& found) {
    FlipSummary s;
    s.hdr = m_plan.hdr;
    s.ppd = m_plan.ppd;
    s.region = m_roi;
    s.reference = side_of(sides.reference);
    s.test = side_of(sides.test);
    s.nonfinite_both = found.nonfinite.alike;
    s.nonfinite_unlike = found.nonfinite.unlike;
    s.alpha_ignored = found.alpha_ignored;
    s.ignored = found.ignored;
    s.warnings = found.notes;
    warn_of_ignored(s.ignored, s.warnings);
    if (m_plan.hdr) {
        s.tonemapper = m_plan.tonemapper;
        s.parameters = m_plan.curve.parameters;
        s.on = m_plan.curve.on;
        s.coeffs = m_plan.curve.coeffs();
        s.bright = m_plan.bright.value_or(0);
        s.baked = m_plan.baked();
        s.bake_error_max = m_exposures.bake.max;
        s.bake_error_mean = m_exposures.bake.mean();
        s.exposures = m_exposures.stops;
        s.max_luminance = m_exposures.max_luminance;
        s.median_luminance = m_exposures.median_luminance;
        s.median_of_lit = m_exposures.median_of_lit;
    }
    s.alpha_compared = m_plan.alpha();
    for (size_t y = 0; y < m_alpha.size(); ++y) {
        s.alpha_mean += m_alpha[y].sum;
        if (m_alpha[y].max > s.alpha_max) {
            s.alpha_max = m_alpha[y].max;
            s.alpha_max_x = m_alpha[y].max_x;
            s.alpha_max_y = m_roi.ybegin + int(y);
        }
    }
    s.pool = pooled(sides.reference.ignored);
    s.alpha_mean /= double(s.pool.pixels);
    collect_warnings(sides.reference, sides.test, s);
    warn_of_unseen(sides, s);
    warn_of_clipped(s);
    return s;
}

// Puts the largest error in the place of its marks.
void FlipMaps::resolve_largest() {
    float* const first = row(m_error, m_roi.ybegin);
    float* const last = first + int64_t(m_roi.width()) * m_roi.height();
    std::replace(first, last, kLargest, std::max(1.0f, *std::max_element(first, last)));
}

void FlipMaps::make_stops() {
    m_stops = make_image(1);
    make_parallel(m_nthreads)(m_roi.height(), [&](int64_t i) {
        const int y = m_roi.ybegin + int(i);
        std::transform(row(m_index, y), row(m_index, y) + m_roi.width(), row(m_stops, y),
                       [&](float n) { return float(m_exposures.stops[size_t(n)]); });
    });
}

void FlipMaps::finish(const ColorPlanes& reference, const ColorPlanes& test, const Found& found,
                      ImageBuf& map, FlipResult& result) {
    result.exposures = std::move(m_pictures);
    if (m_plan.only_shown)
        return;
    if (m_unbounded && (reference.counts.nonfinite > 0 || test.counts.nonfinite > 0))
        resolve_largest();
    result.summary = summarize({reference, test}, found);
    if (!m_plan.pixel_error)
        annotate(m_error.specmod(), result.summary);
    map = std::move(m_error);
    if (m_index.initialized()) {
        make_stops();
        result.exposure_index = std::move(m_index);
        result.exposure_stops = std::move(m_stops);
    }
}

} // namespace tonetool
