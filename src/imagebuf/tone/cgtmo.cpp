// SPDX-License-Identifier: BSD-3-Clause
// The public functions of include/tonetool/cgtmo.h.
#include "tonetool/cgtmo.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <vector>

#include "imagebuf/color/color_reader.h"
#include "imagebuf/color/tone_rows.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/has_pixels.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/row_source.h"
#include "imagebuf/tone/cgtmo_guides.h"
#include "imagebuf/tone/cgtmo_plan.h"
#include "imagebuf/tone/counted_pixels.h"
#include "imagebuf/tone/noise.h"
#include "imagebuf/tone/scene_stats.h"
#include "imagebuf/tone/steady.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

// One call: what is checked, read and measured, then the operator, in place.
class LocalMapping {
public:
    LocalMapping(const ImageBuf& src, const CgTmoOptions& options, int nthreads)
        : m_src(src),
          m_options(with_preset(options)),
          m_nthreads(nthreads),
          m_region(src.roi()) {}

    void run(ImageBuf& dst, ROI roi) {
        check_readable(m_src, "source");
        check_steady(m_options);
        m_plan = plan_local(m_options);
        const ROI part = part_of(m_src, roi);
        ImageBuf whole = read_once(m_src, m_options, m_nthreads);
        m_pixels = whole.initialized() ? &whole : &m_src;
        make(part);
        ImageBuf out = whole.initialized() && same_window(part, whole.roi())
                           ? std::move(whole)
                           : copy_pixels(*m_pixels, part, m_nthreads);
        place(out);
        tag(out.specmod());
        dst = std::move(out);
    }

    CgTmoSummary summary;

private:
    // The picture, in the planes of colour. The guides are gone afterwards, before the result needs
    // memory.
    void make(const ROI& part) {
        read_color();
        LocalGuides guides(m_src, *m_pixels, m_options, m_region, m_nthreads);
        if (m_plan.filter == BaseFilter::Guided)
            guides.read(m_plan.what, summary);
        measure(guides);
        map(guides, part);
    }

    void read_color() {
        m_reader.keep_color_of_any_alpha(); // it only tells which pixels count
        m_reader.keep_infinities();
        m_reader.open(*m_pixels, m_options.pixels, m_region, m_options.count == "lit", m_nthreads);
        m_planes = m_reader.planes();
        m_reader.read(m_region.ybegin, m_region.yend, m_planes);
        summary.layer = m_planes.choice.layer;
        summary.space = m_planes.choice.space;
        summary.nonfinite = m_planes.counts.nonfinite;
        summary.negative = m_planes.counts.negative;
        if (summary.nonfinite > 0)
            summary.warnings.push_back(nonfinite_warning(summary.nonfinite));
    }

    // Lwa and Lmax. Alpha is not looked at again.
    void measure(const LocalGuides& guides) {
        std::vector<uint8_t> found;
        const uint8_t* background = guides.background();
        if (m_options.count == "lit" && m_plan.filter != BaseFilter::Guided) {
            found = background_of(*m_pixels, summary.layer, m_region, m_nthreads);
            background = found.empty() ? nullptr : found.data();
        }
        SceneStats scene =
            measure_scene(*m_pixels, m_options, m_reader, m_planes, background, m_nthreads);
        m_planes.alpha = {};
        summary.counted = scene.counted;
        summary.adaptation = m_plan.what.curve.adaptation = scene.adaptation;
        summary.maximum = m_plan.what.curve.maximum = scene.maximum;
        summary.adaptation_from = scene.adaptation_from;
        summary.maximum_from = scene.maximum_from;
        summary.maximum_light = scene.maximum_light;
        summary.light_index = scene.light_index;
        summary.adapted = scene.adapted;
        summary.unit = scene.unit;
        summary.ev100 = scene.ev100;
        summary.warnings.insert(summary.warnings.end(), scene.warnings.begin(),
                                scene.warnings.end());
        summary.notes.insert(summary.notes.end(), scene.notes.begin(), scene.notes.end());
        m_luminance = std::move(scene.luminance);
    }

    // The colours of a part of the region become display light.
    void map(const LocalGuides& guides, const ROI& part) {
        kernels::GuidePlanes image;
        image.stride = image.width = m_region.width();
        image.height = m_region.height();
        if (m_plan.filter == BaseFilter::Guided)
            image = guides.view();
        summary.samples = m_plan.samples;
        const kernels::Window window{part.xbegin - m_region.xbegin, part.ybegin - m_region.ybegin,
                                     part.width(), part.height()};
        const bool steady = m_options.steady && map_steadily(image, window);
        if (!steady && (m_plan.filter == BaseFilter::Wls || m_plan.show != LocalShow::Picture))
            map_on_base(image, window);
        else if (!steady)
            map_at_once(image, window);
        m_luminance = {};
    }

    tonemap::LocalOutput output(const kernels::Window& window) {
        const ptrdiff_t stride = m_region.width();
        tonemap::LocalOutput out;
        out.stride = stride;
        for (size_t c = 0; c < 3; ++c)
            out.rgb[c] = m_planes.plane[c].data() + window.y0 * stride + window.x0;
        return out;
    }

    void take_logarithms(kernels::GuidePlanes& image, const kernels::ParallelFor& parallel) {
        tonemap::take_logarithms(m_plan.what, m_luminance.data(), m_region.width(),
                                 m_region.height(), parallel);
        image.value = m_luminance.data();
        if (!m_plan.what.edges || m_plan.what.edges->denoise == 0)
            return;
        m_noise = m_options.noise.empty()
                      ? measured_noise(image, parallel)
                      : noise_of_layer(m_src, m_options.noise, m_region, image.value, m_nthreads);
        m_plan.what.edges->noise = m_noise.data();
    }

    void map_at_once(kernels::GuidePlanes& image, const kernels::Window& window) {
        const auto parallel = make_parallel(m_nthreads);
        take_logarithms(image, parallel);
        tonemap::tone_map_guided(m_plan.what, m_planes.view(), image,
                                 taps_of(m_plan, m_options.sigma), window, output(window),
                                 parallel);
    }

    // On the base of the frames about this one; false: there is none.
    bool map_steadily(const kernels::GuidePlanes& image, const kernels::Window& window) {
        const auto found =
            steady_result(m_options, m_plan.what, image, window, summary, m_nthreads);
        if (!found)
            return false;
        const auto parallel = make_parallel(m_nthreads);
        const tonemap::LocalOutput to = output(window);
        const bool share = m_plan.show == LocalShow::Share;
        parallel(window.height, [&](int64_t y) {
            const ptrdiff_t from = y * window.width;
            for (size_t c = 0; c < 3; ++c)
                for (int x = 0; x < window.width; ++x) {
                    float& v = to.rgb[c][y * to.stride + x];
                    v = share ? found->share[size_t(from + x)] : v * found->gain[size_t(from + x)];
                }
        });
        if (!share)
            show_base({found->base.data(), window.width}, window);
        return true;
    }

    void map_on_base(kernels::GuidePlanes& image, const kernels::Window& window) {
        const auto parallel = make_parallel(m_nthreads);
        const tonemap::LocalOutput to = output(window);
        if (m_plan.show == LocalShow::Share) {
            take_logarithms(image, parallel);
            return tonemap::guided_share(m_plan.what, image, taps_of(m_plan, m_options.sigma),
                                         window, to.rgb[0], to.stride, parallel);
        }
        PagedArray<float> kept;
        tonemap::LocalBase base;
        if (m_plan.filter == BaseFilter::Wls) {
            // It has no window: the base is that of the whole image.
            const ptrdiff_t width = m_region.width();
            tonemap::wls_base(m_plan.wls, m_luminance.data(), int(width), m_region.height(),
                              m_luminance.data());
            base = {m_luminance.data() + window.y0 * width + window.x0, width};
        } else {
            kept.resize(size_t(window.width) * size_t(window.height));
            take_logarithms(image, parallel);
            tonemap::guided_base(m_plan.what, image, taps_of(m_plan, m_options.sigma), window,
                                 kept.data(), window.width, parallel);
            base = {kept.data(), window.width};
        }
        show_base(base, window);
    }

    // The picture on its base, or a factor of its luminance.
    void show_base(const tonemap::LocalBase& base, const kernels::Window& window) {
        const auto parallel = make_parallel(m_nthreads);
        const tonemap::LocalOutput to = output(window);
        if (m_plan.show == LocalShow::Picture)
            return tonemap::tone_map_local(m_plan.what, m_planes.view(), base, window, to,
                                           parallel);
        // The first plane stands for all three.
        tonemap::local_part(m_plan.what, m_planes.view(), base, window,
                            m_plan.show == LocalShow::Base ? tonemap::LocalPart::Base
                                                           : tonemap::LocalPart::Detail,
                            to.rgb[0], to.stride, parallel);
    }

    // What was made of the pixels of `out` into its colour channels.
    void place(ImageBuf& out) const {
        const ImageSpec& spec = out.spec();
        const int to[3] = {m_planes.choice.r, m_planes.choice.g, m_planes.choice.b};
        auto* pixels = static_cast<float*>(out.localpixels());
        make_parallel(m_nthreads)(spec.height, [&](int64_t y) {
            const float* rgb[3];
            m_planes.row(spec.x, spec.y + int(y), rgb);
            if (m_plan.show != LocalShow::Picture)
                rgb[1] = rgb[2] = rgb[0];
            float* pixel = pixels + y * spec.width * spec.nchannels;
            for (int x = 0; x < spec.width; ++x, pixel += spec.nchannels) {
                float color[3] = {rgb[0][x], rgb[1][x], rgb[2][x]};
                if (m_plan.show == LocalShow::Picture)
                    finish(color);
                for (size_t c = 0; c < 3; ++c)
                    pixel[to[c]] = color[c];
            }
        });
    }

    void finish(float (&color)[3]) const {
        if (m_options.clamp)
            tonemap::clip_color(m_plan.clip, m_plan.what.curve.weights, color);
        for (float& v : color)
            v = m_plan.encode(v > 0 ? v : 0);
    }

    void tag(ImageSpec& spec) const {
        const bool picture = m_plan.show == LocalShow::Picture;
        retag(spec, space_of_encoding(picture ? m_options.encode : "none"));
        spec.attribute("tonemap:layer", summary.layer);
        const std::pair<const char*, std::string> texts[] = {
            {"tonemap:curve", "cgtmo"},
            {"tonemap:show", m_options.show},
            {"tonemap:position", summary.position},
            {"tonemap:normal", summary.normal},
            {"tonemap:albedo", summary.albedo},
            {"tonemap:adaptation_from", summary.adaptation_from},
            {"tonemap:maximum_from", summary.maximum_from},
            {"tonemap:maximum_light", summary.maximum_light},
            {"tonemap:adapted", summary.adapted}};
        for (const auto& [name, text] : texts)
            if (!text.empty())
                spec.attribute(name, text);
        spec.attribute("tonemap:adaptation", float(summary.adaptation));
        spec.attribute("tonemap:maximum", float(summary.maximum));
        if (summary.ev100) {
            spec.attribute("tonemap:unit", float(summary.unit));
            spec.attribute("tonemap:ev100", float(*summary.ev100));
        }
    }

    const ImageBuf& m_src;
    const ImageBuf* m_pixels = nullptr; ///< where they are read: the source, or all of it in memory
    const CgTmoOptions m_options;
    int m_nthreads;
    ROI m_region;
    LocalPlan m_plan;
    ColorReader m_reader;
    ColorPlanes m_planes;
    PagedArray<float> m_luminance, m_noise;
};

} // namespace

bool ToneAlgo::cg_tmo(ImageBuf& dst, const ImageBuf& src, const CgTmoOptions& options,
                      CgTmoSummary* summary, ROI roi, int nthreads) {
    return guarded(dst, "cg_tmo", [&] {
        LocalMapping mapping(src, options, nthreads);
        mapping.run(dst, roi);
        if (summary)
            *summary = mapping.summary;
    });
}

ImageBuf ToneAlgo::cg_tmo(const ImageBuf& src, const CgTmoOptions& options, CgTmoSummary* summary,
                          ROI roi, int nthreads) {
    ImageBuf dst;
    cg_tmo(dst, src, options, summary, roi, nthreads);
    return dst;
}

} // namespace tonetool
