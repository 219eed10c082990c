// SPDX-License-Identifier: BSD-3-Clause
// ToneAlgo::tonemap.
#include "tonetool/tonemap.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <mutex>

#include "imagebuf/color/color_source.h"
#include "imagebuf/color/curve_plan.h"
#include "imagebuf/color/tone_rows.h"
#include "imagebuf/color/view.h"
#include "imagebuf/options/tone_options.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/names.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/planes.h"
#include "imagebuf/pixels/row_source.h"
#include "imagebuf/tone/calibrate.h"
#include "kernels/curve_rows.h"
#include "metrics/refusal.h"
#include "tonemap/clip.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

// One call of tonemap: what is checked and found first, then the rows.
class Mapping {
public:
    Mapping(const ImageBuf& src, const TonemapOptions& options, int nthreads)
        : m_src(src),
          m_options(options),
          m_nthreads(nthreads) {}

    void run(ImageBuf& dst, ROI roi) {
        check_readable(m_src, "source");
        if (!m_options.calibration.show.empty())
            throw Refusal("show is of calibrate");
        find_channels();
        if (m_options.view)
            open_view();
        else
            open_curve();
        ImageBuf out = copy_pixels(m_src, part_of(m_src, roi), m_nthreads);
        map_rows(out);
        tag(out.specmod());
        warn();
        dst = std::move(out);
    }

    TonemapSummary summary;

private:
    // The configuration of a view knows its own spaces, but neither the gamma of a file nor that
    // colour was multiplied by alpha after it was encoded.
    bool must_decode(const ImageSpec& spec) const {
        if (!m_options.view || !m_options.pixels.from.empty())
            return false;
        try {
            ColorChoice choice;
            ColorSpace space;
            find_picture(spec, m_options.pixels, choice, space);
            return space.gamma > 0 || space.straight;
        } catch (const Refusal&) {
            return false;
        }
    }

    void find_channels() {
        ColorChoice choice;
        const ImageSpec spec = deciding_spec(m_src);
        PixelOptions pixels = m_options.pixels;
        m_decode = must_decode(spec);
        if (m_options.view && !m_decode)
            pixels.from = "rec709";
        find_picture(spec, pixels, choice, m_space);
        m_channels = {{choice.r, choice.g, choice.b}, choice.a, m_options.unpremult};
        summary.layer = choice.layer;
    }

    void open_view() {
        if (m_options.calibration.white_percentile)
            throw Refusal("white is of curves: a view has no such parameter");
        ImageSpec spec = deciding_spec(m_src);
        if (m_decode)
            retag(spec, "lin_rec709");
        m_view.open(*m_options.view, m_options.pixels.from, spec);
        m_calibration.make(m_src, m_options.pixels, m_options.calibration, m_nthreads);
        summary.curve = m_view.display() + "/" + m_view.view();
        summary.space = m_view.from();
        summary.on = "color";
        summary.calibration = m_calibration.summary();
    }

    void open_curve() {
        check_output();
        check_white();
        m_calibration.make(m_src, m_options.pixels, m_options.calibration, m_nthreads);
        CurveOptions curve = m_options.curve;
        if (m_options.calibration.white_percentile)
            curve.parameters["white"] = m_calibration.summary().white;
        m_curve = refusing_as(
            [&](const std::string& why) {
                return why + (m_options.calibration.white_percentile
                                  ? " (white is what was measured)"
                                  : "");
            },
            [&] { return plan_curve(curve, false, m_options.encode); });
        const bool by_channel = m_clip == tonemap::Clip::Channel;
        m_curve.use.clamp = m_options.clamp && by_channel;
        m_clips = m_options.clamp && !by_channel;
        if (!rec709())
            m_curve.use.weights = luminance_weights();
        summary.curve = m_curve.name;
        summary.parameters = m_curve.parameters;
        summary.table = m_curve.table_text();
        summary.on = m_curve.on;
        summary.space = m_space.name;
        summary.calibration = m_calibration.summary();
    }

    bool rec709() const { return m_options.primaries == "rec709"; }

    // Of the image's own primaries: those of Rec.709 behind the matrix.
    std::array<double, 3> luminance_weights() const {
        std::array<double, 3> weights{};
        for (size_t i = 0; i < 3; ++i)
            for (size_t j = 0; j < 3; ++j)
                weights[j] += kernels::kLuminance[i] * m_space.to_rec709[i][j];
        return weights;
    }

    void check_output() {
        if (m_options.primaries != "rec709" && m_options.primaries != "image")
            throw Refusal("primaries is \"" + m_options.primaries + "\"; valid: rec709, image");
        const auto clips = clip_names();
        const auto clip = std::find(clips.begin(), clips.end(), m_options.clip);
        if (clip == clips.end())
            throw Refusal(unknown_name("clip", m_options.clip, clips));
        m_clip = tonemap::Clip(clip - clips.begin());
        m_encode = find_encoding(m_options.encode);
        if (!m_encode)
            throw Refusal(
                unknown_name("encoding", m_options.encode, ToneAlgo::display_encodings()));
        if (m_options.encode != "none" && !rec709() && !m_space.is_rec709)
            throw Refusal("encode=" + m_options.encode +
                          " is for displays of Rec.709's primaries, but " +
                          "primaries=image keeps those of " + m_space.name);
    }

    void check_white() const {
        if (m_options.calibration.white_percentile && !has_parameter(m_options.curve, "white"))
            throw Refusal((is_rational(m_options.curve) ? "coeffs" : m_options.curve.name) +
                          ": has no parameter white that could be measured");
    }

    void map_rows(ImageBuf& out) {
        const ImageSpec& spec = out.spec();
        const auto width = size_t(spec.width);
        auto* pixels = static_cast<float*>(out.localpixels());
        std::mutex lock;
        make_parallel(m_nthreads)(spec.height, [&](int64_t y) {
            ToneRow row(width);
            ToneCounts counts;
            float* at = pixels + size_t(y) * width * size_t(spec.nchannels);
            take_row(at, spec.nchannels, m_channels, row, width, counts);
            m_calibration.row(spec.y + int(y), spec.x, spec.x + spec.width, row.factor.data());
            if (m_options.view)
                look(row, width, counts);
            else
                map(row, width, counts);
            put_row(row, width, m_channels, at, spec.nchannels);
            const std::lock_guard<std::mutex> hold(lock);
            summary.nonfinite += counts.nonfinite;
            summary.negative += counts.negative;
        });
    }

    void map(ToneRow& row, size_t width, ToneCounts& counts) const {
        linearize_row(m_space, rec709(), row, width, counts);
        float scale = m_calibration.factor();
        if (!m_calibration.uniform()) {
            scale = 1;
            for (float* plane : row.rgb)
                for (size_t x = 0; x < width; ++x)
                    plane[x] *= row.factor[x];
        }
        kernels::curve_rows(m_curve.numbers, m_curve.use, row.rgb, row.rgb, ptrdiff_t(width),
                            scale);
        if (m_clips)
            clip(row, width);
        if (m_options.encode != "none")
            for (float* plane : row.rgb)
                std::transform(plane, plane + width, plane, m_encode);
    }

    void clip(ToneRow& row, size_t width) const {
        const auto weights = rec709() ? kernels::kLuminance : luminance_weights();
        for (size_t x = 0; x < width; ++x) {
            float color[3] = {row.rgb[0][x], row.rgb[1][x], row.rgb[2][x]};
            tonemap::clip_color(m_clip, weights, color);
            for (size_t c = 0; c < 3; ++c)
                row.rgb[c][x] = color[c];
        }
    }

    void look(ToneRow& row, size_t width, ToneCounts& counts) const {
        if (m_decode || m_space.scale != 1)
            linearize_row(m_space, true, row, width, counts);
        std::vector<float> packed(3 * width);
        for (size_t x = 0; x < width; ++x)
            for (size_t c = 0; c < 3; ++c)
                packed[3 * x + c] = row.rgb[c][x] * row.factor[x];
        m_view.apply(packed.data(), ptrdiff_t(width));
        for (size_t x = 0; x < width; ++x)
            for (size_t c = 0; c < 3; ++c)
                row.rgb[c][x] = packed[3 * x + c];
    }

    // What the values are now, and how they came to be.
    void tag(ImageSpec& spec) const {
        std::string space = m_view.space();
        if (!m_options.view)
            space = m_options.encode == "none" && !rec709() && !m_space.is_rec709
                        ? m_space.name
                        : space_of_encoding(m_options.encode);
        retag(spec, space, !m_options.view && !rec709());
        spec.attribute("tonemap:layer", summary.layer);
        spec.attribute("tonemap:curve", summary.curve);
        std::vector<std::string> parameters;
        for (const auto& [name, value] : summary.parameters)
            parameters.push_back(format("{}={}", name, value));
        if (!parameters.empty())
            spec.attribute("tonemap:parameters", OIIO::Strutil::join(parameters, " "));
        spec.attribute("tonemap:on", summary.on);
        if (!summary.calibration.adapted.empty())
            spec.attribute("tonemap:adapted", summary.calibration.adapted);
        spec.attribute("tonemap:exposure", float(summary.calibration.exposure));
        if (summary.calibration.unit > 0)
            spec.attribute("tonemap:unit", float(summary.calibration.unit));
        if (summary.calibration.ev100)
            spec.attribute("tonemap:ev100", float(*summary.calibration.ev100));
    }

    void warn() {
        summary.warnings = summary.calibration.warnings;
        if (summary.nonfinite > 0)
            summary.warnings.push_back(nonfinite_warning(summary.nonfinite));
    }

    const ImageBuf& m_src;
    const TonemapOptions& m_options;
    int m_nthreads;
    ToneChannels m_channels{};
    ColorSpace m_space;
    CurvePlan m_curve;
    ViewTransform m_view;
    bool m_decode = false; ///< what a view gets is decoded before
    Calibration m_calibration;
    Encoding m_encode = nullptr;
    tonemap::Clip m_clip = tonemap::Clip::Channel;
    bool m_clips = false; ///< colours, not channels
};

} // namespace

namespace ToneAlgo {

bool tonemap(ImageBuf& dst, const ImageBuf& src, const TonemapOptions& options,
             TonemapSummary* summary, ROI roi, int nthreads) {
    return guarded(dst, "tonemap", [&] {
        Mapping mapping(src, options, nthreads);
        mapping.run(dst, roi);
        if (summary)
            *summary = mapping.summary;
    });
}

ImageBuf tonemap(const ImageBuf& src, const TonemapOptions& options, TonemapSummary* summary,
                 ROI roi, int nthreads) {
    ImageBuf dst;
    tonemap(dst, src, options, summary, roi, nthreads);
    return dst;
}

} // namespace ToneAlgo
} // namespace tonetool
