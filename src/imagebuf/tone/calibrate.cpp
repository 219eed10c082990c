// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/tone/calibrate.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/options/shot_options.h"
#include "imagebuf/options/tone_options.h"
#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/row_source.h"
#include "imagebuf/tone/counted_pixels.h"
#include "imagebuf/tone/header_light.h"
#include "imagebuf/tone/shot_statistics.h"
#include "metrics/order_statistics.h"
#include "metrics/refusal.h"
#include "tonemap/cell_mean.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

std::string name_of(CalibrationMethod method) {
    constexpr const char* names[] = {"manual", "mean", "auto", "camera"};
    return names[size_t(method)];
}

bool needs_unit(const CalibrationOptions& options) {
    return options.method == CalibrationMethod::AutoKey ||
           options.method == CalibrationMethod::Camera;
}

double unit_of(const ShotLight& shot) {
    if (shot.least_unit == 0 && shot.largest_unit > 0)
        throw Refusal(
            format("adapt: some frames have no whiteLuminance, and others have {} (valid: "
                   "unit=X)",
                   shot.largest_unit));
    if (shot.least_unit != shot.largest_unit)
        throw Refusal(format("adapt: the whiteLuminance of the frames is {} to {} (valid: unit=X)",
                             shot.least_unit, shot.largest_unit));
    return shot.largest_unit;
}

void check(const CalibrationOptions& options, const ImageBuf& image) {
    const OIIO::ImageSpec& spec = image.spec();
    const int most = tonemap::LocalMeans::most_levels(spec.width, spec.height);
    if (options.level < 0 || options.level > most)
        throw Refusal(format("level is {}: must be 0 to {} for an image of {} x {} pixels",
                             options.level, most, spec.width, spec.height));
    const bool by_mean =
        options.method == CalibrationMethod::Mean || options.method == CalibrationMethod::AutoKey;
    if (options.level > 0 && !by_mean)
        throw Refusal("local means need a calibration by means: method mean or auto");
    check_options(options);
    check_options(options.adapt);
    if (options.method != CalibrationMethod::Camera)
        refuse_camera(options, name_of(options.method));
    const bool skips = options.skip_black || options.skip_transparent;
    if (skips && options.count == "lit")
        throw Refusal("count=lit leaves out what skipblack and skiptransparent would: say one");
    if (options.level > 0 && options.means == "cells")
        throw Refusal("means=cells is one mean for the image: level has cells of its own");
    if (options.white_percentile)
        check_range(*options.white_percentile, 0.001, 100, "white percentile");
}

bool counts_lit(const CalibrationOptions& options) {
    return options.count.empty() ? !options.skip_black && !options.skip_transparent
                                 : options.count == "lit";
}

// Pixels that are not to be in the statistics become NaN.
void leave_out(const CalibrationOptions& options, const ColorPlanes& planes,
               std::vector<float>& luminance) {
    for (size_t i = 0; i < luminance.size(); ++i)
        if ((options.skip_black && luminance[i] == 0) ||
            (options.skip_transparent && planes.choice.a >= 0 && planes.alpha.data()[i] == 0))
            luminance[i] = std::numeric_limits<float>::quiet_NaN();
}

} // namespace

void Calibration::make(const ImageBuf& image, const PixelOptions& pixels,
                       const CalibrationOptions& options, int nthreads) {
    m_options = options;
    m_region = image.roi();
    m_summary = {};
    check(options, image);
    m_summary.exposure = options.stops;
    m_factor = float(std::exp2(options.stops));
    const OIIO::ImageSpec& spec = image.spec();
    const bool camera = options.method == CalibrationMethod::Camera;
    if (camera || (!adapts(options.adapt) && needs_unit(options)))
        m_summary.unit = unit_or_1(options.adapt.unit, header_unit(spec), m_summary.notes);
    else if (!adapts(options.adapt))
        check_unit(options.adapt, "", name_of(options.method));
    if (camera)
        expose_by_camera(spec);
    const bool measured = ToneAlgo::measures(options);
    if (adapts(options.adapt) && !measured)
        throw Refusal(
            "adapt: nothing is measured (valid: method mean or auto, or a white that is)");
    if (adapts(options.adapt))
        take_shot();
    else if (measured)
        measure(image, pixels, nthreads);
}

// The shot's light instead of the image's.
void Calibration::take_shot() {
    if (const std::string why = ToneAlgo::not_of_shots(m_options); !why.empty())
        throw Refusal("adapt: " + why + ", or adapt=frame");
    const ShotLight shot = light_of_shot(m_options.adapt, m_options.white_percentile);
    const ShotExposure& light = shot.exposure;
    m_summary.pixels = light.counted;
    m_summary.adapted = shot_words(light);
    m_summary.warnings = light.warnings;
    m_summary.notes.insert(m_summary.notes.end(), light.notes.begin(), light.notes.end());
    if (!needs_unit(m_options))
        check_unit(m_options.adapt, light.mode, name_of(m_options.method));
    if (m_options.method == CalibrationMethod::AutoKey)
        m_summary.unit = unit_or_1(m_options.adapt.unit, m_options.adapt.unit ? 0 : unit_of(shot),
                                   m_summary.notes);
    if (by_mean())
        expose(m_options.means == "cells" ? light.lwa : light.lwa_geometric);
    if (m_options.white_percentile)
        m_summary.white = shot.white * m_factor;
}

void Calibration::expose_by_camera(const OIIO::ImageSpec& spec) {
    const tonemap::CameraSettings camera = camera_settings(m_options, spec);
    const double scale = m_summary.unit / tonemap::saturation_luminance(camera);
    m_summary.ev100 = tonemap::ev100(camera);
    m_summary.exposure = m_options.stops + std::log2(scale);
    m_factor = float(scale * std::exp2(m_options.stops));
}

double Calibration::key_of(double mean) const {
    return m_options.method == CalibrationMethod::Mean ? m_options.key
                                                       : tonemap::auto_key(mean * m_summary.unit);
}

void Calibration::expose(double mean) {
    m_summary.mean = mean;
    m_summary.key = key_of(mean);
    m_summary.exposure = std::log2(factor_of(mean));
    m_factor = float(factor_of(mean));
}

double Calibration::factor_of(double mean) const {
    return std::exp2(m_options.stops) * tonemap::gain(key_of(mean), mean);
}

void Calibration::measure(const ImageBuf& image, const PixelOptions& pixels, int nthreads) {
    ColorReader reader;
    const bool lit = counts_lit(m_options), alpha = m_options.skip_transparent || lit;
    reader.open(image, pixels, m_region, alpha, nthreads);
    ColorPlanes planes = reader.planes();
    reader.read(m_region.ybegin, m_region.yend, planes);
    const auto plane = read_luminance(reader, planes, nthreads);
    std::vector<float> luminance(plane.data(), plane.data() + luminance_bytes(m_region) / 4);
    leave_out(m_options, planes, luminance);
    const double of_cells =
        lit ? keep_lit(image, planes, luminance, nthreads) : cells_of(luminance.data(), nthreads);
    auto means = std::make_unique<tonemap::LocalMeans>(luminance.data(), m_region.width(),
                                                       m_region.height(), m_options.level,
                                                       m_options.epsilon, make_parallel(nthreads));
    m_summary.pixels = means->pixels();
    if (m_summary.pixels == 0)
        throw Refusal(
            "no pixel is left for the statistics (non-finite, black and transparent ones are "
            "left out as asked)");
    if (by_mean())
        expose(m_options.means == "cells" ? of_cells : means->mean());
    if (m_options.level > 0)
        m_means = std::move(means);
    if (m_options.white_percentile)
        find_white(luminance, nthreads);
}

double Calibration::cells_of(const float* plane, int nthreads) const {
    if (m_options.means != "cells")
        return 0;
    return tonemap::cell_mean(plane, m_region.width(), m_region.height(), make_parallel(nthreads))
        .mean;
}

// Leaves out what shows nothing, and returns the mean of cells, if it is wanted. A picture that is
// all black stays what it is unless it was asked for light.
double Calibration::keep_lit(const ImageBuf& image, const ColorPlanes& planes,
                             std::vector<float>& luminance, int nthreads) const {
    // What shows no surface matters only where there is no light.
    const bool dark =
        std::any_of(luminance.begin(), luminance.end(), [](float v) { return v <= 0; });
    const auto background = dark ? background_of(image, planes.choice.layer, m_region, nthreads)
                                 : std::vector<uint8_t>();
    const bool alpha = planes.choice.a >= 0 && !planes.alpha.empty();
    const CountedPixels counted = counted_pixels(
        luminance.data(), m_region.width(), m_region.height(),
        {alpha ? planes.alpha.data() : nullptr, background.empty() ? nullptr : background.data()},
        make_parallel(nthreads));
    if (counted.lit == 0 && m_options.count.empty())
        return cells_of(luminance.data(), nthreads);
    for (size_t i = 0; i < luminance.size(); ++i) {
        const float v = counted.luminance[i];
        luminance[i] = v == tonemap::kBlackSurface ? 0
                       : v > 0                     ? v
                                                   : std::numeric_limits<float>::quiet_NaN();
    }
    return cells_of(counted.luminance.data(), nthreads);
}

void Calibration::find_white(std::vector<float>& luminance, int nthreads) {
    const auto parallel = make_parallel(nthreads);
    const auto width = size_t(m_region.width());
    parallel(m_region.height(), [&](int64_t y) {
        std::vector<float> factors(width);
        row(m_region.ybegin + int(y), m_region.xbegin, m_region.xend, factors.data());
        for (size_t x = 0; x < width; ++x)
            luminance[size_t(y) * width + x] *= factors[x];
    });
    const metrics::OrderStatistics order(luminance.data(), m_region.width(), m_region.height(),
                                         m_region.width(), parallel);
    m_summary.white =
        order.find({metrics::Wanted::percentile(*m_options.white_percentile / 100)})[0];
}

void Calibration::row(int y, int xbegin, int xend, float* out) const {
    if (uniform()) {
        std::fill(out, out + (xend - xbegin), m_factor);
        return;
    }
    std::vector<double> means(static_cast<size_t>(xend - xbegin));
    means_row(y, xbegin, xend, means.data());
    std::transform(means.begin(), means.end(), out,
                   [&](double mean) { return float(factor_of(mean)); });
}

// The mean that each pixel's exposure follows from.
void Calibration::means_row(int y, int xbegin, int xend, double* out) const {
    if (uniform()) {
        std::fill(out, out + (xend - xbegin), m_summary.mean);
        return;
    }
    std::vector<double> means(size_t(m_region.width()));
    m_means->row(y - m_region.ybegin, means.data());
    std::copy_n(means.begin() + (xbegin - m_region.xbegin), xend - xbegin, out);
}

void Calibration::shown_row(int y, int xbegin, int xend, float* out) const {
    if (m_options.show == "exposure") {
        row(y, xbegin, xend, out);
        return;
    }
    std::vector<double> means(static_cast<size_t>(xend - xbegin));
    means_row(y, xbegin, xend, means.data());
    const bool key = m_options.show == "key";
    std::transform(means.begin(), means.end(), out,
                   [&](double mean) { return float(key ? key_of(mean) : mean); });
}

namespace {

void check_shown(const CalibrationOptions& options) {
    const std::vector<std::string> parts = calibration_parts();
    if (options.show.empty())
        return;
    if (std::find(parts.begin(), parts.end(), options.show) == parts.end())
        throw Refusal(unknown_name("show", options.show, parts));
    const bool by_mean =
        options.method == CalibrationMethod::Mean || options.method == CalibrationMethod::AutoKey;
    if (!by_mean && options.show != "exposure")
        throw Refusal("show=" + options.show +
                      " needs a calibration by means: method mean or auto (valid: exposure)");
}

void scaled(ImageBuf& dst, const ImageBuf& src, const CalibrationOptions& options,
            const PixelOptions& pixels, ROI roi, int nthreads, CalibrationSummary* summary) {
    check_readable(src, "source");
    const ColorChoice choice = chosen_color(deciding_spec(src), pixels);
    if (choice.display_encoded)
        throw Refusal("the image is display-encoded (" + choice.space +
                      "): calibration needs linear values; convert it first or pass from=");
    if (options.white_percentile)
        throw Refusal("white is of tone curves: it belongs to tonemap");
    check_shown(options);
    const ROI part = part_of(src, roi);
    Calibration calibration;
    calibration.make(src, pixels, options, nthreads);
    ImageBuf out = copy_pixels(src, part, nthreads);
    const OIIO::ImageSpec& spec = out.spec();
    auto* data = static_cast<float*>(out.localpixels());
    const bool picture = options.show.empty();
    make_parallel(nthreads)(spec.height, [&](int64_t y) {
        std::vector<float> factors(static_cast<size_t>(spec.width));
        const int xend = spec.x + spec.width;
        if (picture)
            calibration.row(spec.y + int(y), spec.x, xend, factors.data());
        else
            calibration.shown_row(spec.y + int(y), spec.x, xend, factors.data());
        float* pixel = data + y * spec.width * spec.nchannels;
        for (float factor : factors) {
            for (int c : channels_of(choice))
                pixel[c] = picture ? pixel[c] * factor : factor;
            pixel += spec.nchannels;
        }
    });
    if (summary)
        *summary = calibration.summary();
    dst = std::move(out);
}

} // namespace

bool ToneAlgo::calibrate(ImageBuf& dst, const ImageBuf& src, const CalibrationOptions& calibration,
                         const PixelOptions& options, CalibrationSummary* summary, ROI roi,
                         int nthreads) {
    return guarded(dst, "calibrate",
                   [&] { scaled(dst, src, calibration, options, roi, nthreads, summary); });
}

} // namespace tonetool
