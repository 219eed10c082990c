// SPDX-License-Identifier: BSD-3-Clause
// ToneAlgo::bloom.
#include "tonetool/bloom.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "imagebuf/aov/camera.h"
#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/options/bloom_options.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/row_source.h"
#include "tonemap/bloom.h"
#include "tonetool/shot.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

constexpr double kUsualRadius = 0.03; // of the width
// Stops of a threshold.
constexpr double kMostStops = 126;

// A threshold in stops ends in "s".
bool in_stops(const std::string& threshold) {
    return OIIO::Strutil::ends_with(threshold, "s");
}

double number_of_threshold(const std::string& text) {
    const std::string number = in_stops(text) ? text.substr(0, text.size() - 1) : text;
    const double least = in_stops(text) ? -kMostStops : 0,
                 most = in_stops(text) ? kMostStops : 1e30;
    const double value =
        OIIO::Strutil::string_is_float(number) ? OIIO::Strutil::from_string<double>(number) : NAN;
    if (!(value >= least && value <= most))
        throw Refusal(format("threshold is \"{}\": must be a luminance, 0 or more, or Ns, {} to {} "
                             "stops above the mean",
                             text, -kMostStops, kMostStops));
    return value;
}

void check_bloom(const BloomOptions& o) {
    check_options(o);
    (void)number_of_threshold(o.threshold);
    const bool eye = o.psf == "spencer";
    const std::pair<const char*, bool> others[] = {{"fov", !eye && o.fov},
                                                   {"vision", !eye && o.vision != "photopic"},
                                                   {"radius", eye && o.radius}};
    for (const auto& [name, given] : others)
        if (given)
            throw Refusal(format("{} is of psf={}, and this is psf={}", name,
                                 eye ? "gaussian" : "spencer", o.psf));
}

// One call: what spreads, how it spreads, and the picture with it.
class Blooming {
public:
    Blooming(const ImageBuf& src, const BloomOptions& options, int nthreads)
        : m_src(src),
          m_options(options),
          m_parallel(make_parallel(nthreads)),
          m_nthreads(nthreads) {}

    ImageBuf run(ROI roi) {
        check_readable(m_src, "source");
        check_bloom(m_options);
        const ImageSpec deciding = deciding_spec(m_src);
        m_choice = chosen_color(deciding, m_options.pixels);
        if (m_choice.display_encoded)
            throw Refusal("the image is display-encoded (" + m_choice.space +
                          "): bloom needs linear values; convert it first or pass from=");
        const ROI part = part_of(m_src, roi);
        m_out = copy_pixels(m_src, part_of(m_src, {}), m_nthreads);
        measure();
        find_reach();
        if (m_options.amount > 0 && summary.spreading > 0)
            spread();
        return same_window(part, m_out.roi()) ? std::move(m_out)
                                              : copy_pixels(m_out, part, m_nthreads);
    }

    BloomSummary summary;

private:
    bool eye() const { return m_options.psf == "spencer"; }
    size_t width() const { return size_t(m_out.spec().width); }

    void find_threshold() {
        const double number = number_of_threshold(m_options.threshold);
        summary.threshold = number;
        if (!in_stops(m_options.threshold))
            return;
        FrameLight light;
        std::string why;
        if (!ToneAlgo::frame_light(light, m_out, why, m_options.pixels, m_nthreads))
            throw Refusal(why);
        summary.lwa = light.lwa;
        summary.threshold = light.lwa * std::exp2(number);
    }

    void measure() {
        find_threshold();
        ColorReader reader;
        reader.open(m_out, m_options.pixels, m_out.roi(), false, m_nthreads);
        ColorPlanes planes = reader.planes();
        m_share = read_luminance(reader, planes, m_nthreads);
        summary.layer = m_choice.layer;
        summary.space = m_choice.space;
        summary.nonfinite = planes.counts.nonfinite;
        if (summary.nonfinite > 0)
            summary.warnings.push_back(format("{} pixel(s) are not finite: they stay as they are "
                                              "and give no light",
                                              summary.nonfinite));
        find_shares();
    }

    struct Sums {
        double all = 0, spread = 0;
        int64_t pixels = 0;
    };

    // The luminances become the shares of their pixels' light that spread.
    void find_shares() {
        std::vector<Sums> rows(size_t(m_out.spec().height));
        m_parallel(m_out.spec().height, [&](int64_t y) {
            Sums& sums = rows[size_t(y)];
            for (size_t i = size_t(y) * width(); i < size_t(y + 1) * width(); ++i) {
                const double light = m_share[i];
                if (std::isnan(light))
                    continue;
                const double above = std::max(0.0, light - summary.threshold);
                sums.all += light;
                sums.spread += above;
                sums.pixels += above > 0;
                m_share[i] = above > 0 ? float(above / light) : 0;
            }
        });
        Sums all;
        for (const Sums& row : rows) {
            all.all += row.all;
            all.spread += row.spread;
            summary.spreading += row.pixels;
        }
        summary.light = all.all > 0 ? all.spread / all.all : 0;
    }

    double field_of_view() {
        const ImageSpec& spec = m_src.spec();
        if (m_options.fov)
            return *m_options.fov;
        const auto camera = find_camera(spec, {});
        if (camera && !camera->parallel)
            return 360 / M_PI * std::atan(camera->step * spec.full_width / 2);
        summary.notes.push_back(format("the image has no worldToCamera and worldToNDC of a "
                                       "perspective: its field of view is taken for {} degrees "
                                       "(fov=)",
                                       kUsualView));
        return kUsualView;
    }

    void find_reach() {
        const double across = std::max(m_src.spec().full_width, 1);
        if (!eye()) {
            m_radius = m_options.radius.value_or(kUsualRadius * across);
            summary.reach = tonemap::kGaussianReach * m_radius;
            return;
        }
        summary.fov = field_of_view();
        m_pixel = summary.fov / across;
        summary.reach = std::min(tonemap::kMostGlare / m_pixel,
                                 double(std::max(m_out.spec().width, m_out.spec().height)));
    }

    // Where only a halo has a colour, one function is that of all channels.
    tonemap::PointSpread function_of(int color) const {
        const tonemap::SpreadSize size{m_out.spec().width, m_out.spec().height, summary.reach};
        if (!eye())
            return tonemap::gaussian_spread(m_radius, size, m_parallel);
        const auto names = {"photopic", "mesopic", "scotopic"};
        const auto found = std::find(names.begin(), names.end(), m_options.vision);
        return tonemap::eye_spread(tonemap::Vision(found - names.begin()),
                                   tonemap::kWavelengths[color], m_pixel, size, m_parallel);
    }

    void spread() {
        const bool colored = eye() && m_options.vision != "photopic";
        const std::vector<int> channels = channels_of(m_choice);
        constexpr int green = 1;
        std::optional<tonemap::Spreading> spreading;
        for (size_t c = 0; c < channels.size(); ++c) {
            const int color = colored && channels.size() == 3 ? int(c) : green;
            if (!spreading || colored) {
                const tonemap::PointSpread function = function_of(color);
                if (color == green)
                    summary.kept = function.at(0, 0);
                spreading.emplace(function, m_out.spec().width, m_out.spec().height, m_parallel);
            }
            spread_channel(channels[c], *spreading);
        }
    }

    void spread_channel(int channel, const tonemap::Spreading& spreading) {
        const auto step = size_t(m_out.spec().nchannels);
        auto* pixels = static_cast<float*>(m_out.localpixels()) + channel;
        const size_t count = m_share.size();
        PagedArray<float> light;
        light.resize(count);
        light.expect_all_written();
        const auto own = [&](size_t i) {
            const float value = pixels[i * step];
            return m_share[i] > 0 && value > 0 ? value * m_share[i] : 0.0f;
        };
        const auto by_rows = [&](const auto& visit) {
            m_parallel(m_out.spec().height, [&](int64_t y) {
                for (size_t i = size_t(y) * width(); i < size_t(y + 1) * width(); ++i)
                    visit(i);
            });
        };
        by_rows([&](size_t i) { light[i] = own(i); });
        spreading.apply(light.data(), m_parallel);
        by_rows([&](size_t i) {
            float& value = pixels[i * step];
            if (!std::isnan(m_share[i]))
                value = float(value + m_options.amount * (double(light[i]) - own(i)));
        });
    }

    const ImageBuf& m_src;
    const BloomOptions& m_options;
    const kernels::ParallelFor m_parallel;
    int m_nthreads;
    ColorChoice m_choice;
    ImageBuf m_out;
    PagedArray<float> m_share; ///< of each pixel's light; NaN: it is not finite
    double m_radius = 0;       ///< of Gaussians, in pixels
    double m_pixel = 0;        ///< in degrees
};

} // namespace

bool ToneAlgo::bloom(ImageBuf& dst, const ImageBuf& src, const BloomOptions& options,
                     BloomSummary* summary, ROI roi, int nthreads) {
    return guarded(dst, "bloom", [&] {
        Blooming blooming(src, options, nthreads);
        dst = blooming.run(roi);
        if (summary)
            *summary = blooming.summary;
    });
}

ImageBuf ToneAlgo::bloom(const ImageBuf& src, const BloomOptions& options, BloomSummary* summary,
                         ROI roi, int nthreads) {
    ImageBuf dst;
    bloom(dst, src, options, summary, roi, nthreads);
    return dst;
}

} // namespace tonetool
