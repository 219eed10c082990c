// The public functions of include/tonetool/cgtmo.h.
#include "include/tonetool/cgtmo.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/checks.h"
#include "imagebuf/color_reader.h"
#include "imagebuf/gbuffer.h"
#include "imagebuf/guard.h"
#include "imagebuf/names.h"
#include "imagebuf/parallel.h"
#include "imagebuf/scene_stats.h"
#include "imagebuf/tone_rows.h"
#include "include/tonetool/tonemap.h"
#include "tonemap/footprint.h"
#include "tonemap/local.h"
#include "tonemap/poisson.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

// As the authors' programs have it: 2.5 sigma to each side.
constexpr double kWindowOfSigma = 2.5;

// One call: what is checked, read and measured, then the operator.
class LocalMapping {
public:
    LocalMapping(const ImageBuf& src, const CgTmoOptions& options, int nthreads)
        : m_src(src),
          m_options(options),
          m_nthreads(nthreads),
          m_region(src.roi()) {}

    bool run(ImageBuf& dst, ROI roi, std::string& error) {
        if (!check_readable(m_src, "source", error) || !plan(error) || !read_color(error) ||
            !measure(error) || !read_guides(error))
            return false;
        ImageBuf out;
        if (!OIIO::ImageBufAlgo::copy(out, m_src, OIIO::TypeFloat, roi, m_nthreads)) {
            error = out.geterror();
            return false;
        }
        map(out);
        tag(out.specmod());
        dst = std::move(out);
        return true;
    }

    CgTmoSummary summary;

private:
    bool plan(std::string& error) {
        const CgTmoOptions& o = m_options;
        m_encode = find_encoding(o.encode);
        if (!m_encode) {
            error = unknown_name("encoding", o.encode, ToneAlgo::display_encodings());
            return false;
        }
        const std::string domain =
            o.domain.empty() ? (o.preset == "paper" ? "linear" : "log") : o.domain;
        if (!one_of("preset", o.preset, {"default", "paper"}, error) ||
            !one_of("domain", domain, {"log", "linear"}, error) ||
            !one_of("filter", o.filter, {"guided", "bilateral", "none"}, error) ||
            !one_of("normaldist", o.normaldist, {"euclid", "dot"}, error) ||
            !in_range(o.sigma, 1, 20, "sigma", error) ||
            !in_range(o.bias, 0.01, 1, "bias", error) ||
            !in_range(o.ldmax, 1, 10000, "ldmax", error) ||
            !in_range(o.saturation, 0, 4, "saturation", error) ||
            !in_range(o.lumsigma.value_or(0), 0, 10, "lumsigma", error) ||
            (o.samples != 0 && !in_range(o.samples, 4, 400, "samples", error)))
            return false;
        m_what.logarithmic = domain == "log";
        m_what.luminance_sigma = o.lumsigma.value_or(o.preset == "paper" ? 0 : kLuminanceSigma);
        if (o.filter == "bilateral" && m_what.luminance_sigma == 0)
            m_what.luminance_sigma = kLuminanceSigma;
        m_what.terms.position = o.sigma;
        m_what.terms.normal_term =
            o.normaldist == "dot" ? kernels::NormalTerm::Angle : kernels::NormalTerm::Distance;
        m_what.curve.bias = o.bias;
        m_what.curve.display_maximum = o.ldmax;
        m_what.curve.saturation = o.saturation;
        return true;
    }

    bool read_color(std::string& error) {
        if (!m_reader.open(m_src, m_options.pixels, m_region, false, m_nthreads, error))
            return false;
        m_planes = m_reader.planes();
        if (!m_reader.read(m_region.ybegin, m_region.yend, m_planes, error))
            return false;
        summary.layer = m_planes.choice.layer;
        summary.space = m_planes.choice.space;
        summary.nonfinite = m_planes.counts.nonfinite;
        summary.negative = m_planes.counts.negative;
        if (summary.nonfinite > 0)
            summary.warnings.push_back(
                format("{} pixel(s) are not finite and became black", summary.nonfinite));
        return true;
    }

    // Lwa and Lmax.
    bool measure(std::string& error) {
        SceneStats scene;
        if (!measure_scene(m_src, m_options, m_reader, m_planes, m_nthreads, scene, error))
            return false;
        summary.adaptation = m_what.curve.adaptation = scene.adaptation;
        summary.maximum = m_what.curve.maximum = scene.maximum;
        summary.adaptation_from = scene.adaptation_from;
        summary.maximum_from = scene.maximum_from;
        summary.maximum_light = scene.maximum_light;
        summary.light_index = scene.light_index;
        summary.warnings.insert(summary.warnings.end(), scene.warnings.begin(),
                                scene.warnings.end());
        return true;
    }

    bool read_guides(std::string& error) {
        const bool guided = m_options.filter == "guided";
        GBufferNames names;
        if (guided) {
            const GuideOptions asked{m_options.position, m_options.normal, m_options.albedo,
                                     m_options.depth, summary.layer};
            if (!find_gbuffer(m_src.spec(), asked, names, error) ||
                !read_gbuffer(m_src, names, m_region, m_nthreads, m_guides, error))
                return false;
            const ImageSpec& file = m_src.nativespec();
            m_half_positions = names.position && file.nchannels == m_src.nchannels() &&
                               file.channelformat(names.position->channel[0]) == OIIO::TypeHalf;
            summary.warnings.insert(summary.warnings.end(), m_guides.warnings.begin(),
                                    m_guides.warnings.end());
        }
        use(m_guides.position, m_view.position, names.position, summary.position);
        use(m_guides.normal, m_view.normal, names.normal, summary.normal);
        use(m_guides.albedo, m_view.albedo, names.albedo, summary.albedo);
        if (names.depth)
            summary.depth = names.depth->layer;
        m_view.stride = m_view.width = m_region.width();
        m_view.height = m_region.height();
        if (guided && !m_guides.background.empty())
            m_view.background = m_guides.background.data();
        summary.background = std::count_if(m_guides.background.begin(), m_guides.background.end(),
                                           [](uint8_t b) { return b != 0; });
        return !guided || (check_missing(error) && find_footprint(error));
    }

    static void use(const std::vector<float> (&plane)[3], const float* (&view)[3],
                    const std::optional<GuideChannels>& found, std::string& layer) {
        if (plane[0].empty() || !found)
            return;
        for (size_t c = 0; c < 3; ++c)
            view[c] = plane[c].data();
        layer = found->layer.empty() ? "plain" : found->layer;
    }

    bool check_missing(std::string& error) {
        const std::pair<const char*, bool> guides[] = {
            {"position", !m_view.position[0] && m_options.position != "none"},
            {"normal", !m_view.normal[0] && m_options.normal != "none"},
            {"albedo", !m_view.albedo[0] && m_options.albedo != "none"}};
        for (const auto& [name, missing] : guides) {
            if (!missing)
                continue;
            const std::string what = format("no {} among the layers", name);
            if (m_options.strict) {
                error = what + "; " + name + "= names one, \"none\" does without";
                return false;
            }
            summary.warnings.push_back(what + ": its term is left out");
        }
        if (!m_view.position[0] && !m_view.normal[0] && !m_view.albedo[0] &&
            m_what.luminance_sigma == 0) {
            m_what.luminance_sigma = kLuminanceSigma;
            summary.warnings.push_back(
                format("without a guide only luminance tells edges: lumsigma={}", kLuminanceSigma));
        }
        return true;
    }

    bool find_footprint(std::string& error) {
        if (!m_view.position[0])
            return true;
        const auto given = number_of(m_options.footprint);
        if (given) {
            if (!in_range(*given, 1e-15, 1e15, "footprint", error))
                return false;
            summary.footprint = m_what.terms.footprint = *given;
            return true;
        }
        if (!one_of("footprint", m_options.footprint, {"pixel", "global", "a number"}, error))
            return false;
        m_footprints.resize(size_t(m_region.width()) * size_t(m_region.height()));
        tonemap::footprints(m_view, m_half_positions ? tonemap::kHalfStep : tonemap::kFloatStep,
                            m_footprints.data(), make_parallel(m_nthreads));
        summary.footprint =
            tonemap::median_footprint(m_footprints.data(), m_region.width(), m_region.height());
        m_what.terms.footprint = summary.footprint > 0 ? summary.footprint : 1;
        if (m_options.footprint == "pixel")
            m_view.footprint = m_footprints.data();
        return true;
    }

    kernels::TapSets taps() {
        const int half =
            m_options.filter == "none" ? 0 : int(std::lround(kWindowOfSigma * m_options.sigma));
        const int window = (2 * half + 1) * (2 * half + 1);
        if (m_options.samples == 0 || m_options.samples >= window || half == 0) {
            summary.samples = window;
            return {{kernels::whole_window(half)}, m_options.sigma};
        }
        summary.samples = m_options.samples;
        return {tonemap::poisson_sets(half, m_options.samples), m_options.sigma};
    }

    void map(ImageBuf& out) {
        const ImageSpec& spec = out.spec();
        const kernels::Window window{spec.x - m_region.xbegin, spec.y - m_region.ybegin, spec.width,
                                     spec.height};
        const size_t size = size_t(spec.width) * size_t(spec.height);
        std::vector<float> mapped[3];
        tonemap::LocalOutput output;
        for (size_t c = 0; c < 3; ++c) {
            mapped[c].resize(size);
            output.rgb[c] = mapped[c].data();
        }
        output.stride = spec.width;
        const auto parallel = make_parallel(m_nthreads);
        tonemap::tone_map_local(m_what, m_planes.view(), m_view, taps(), window, output, parallel);
        const int to[3] = {m_planes.choice.r, m_planes.choice.g, m_planes.choice.b};
        auto* pixels = static_cast<float*>(out.localpixels());
        parallel(spec.height, [&](int64_t y) {
            float* pixel = pixels + y * spec.width * spec.nchannels;
            for (int x = 0; x < spec.width; ++x, pixel += spec.nchannels)
                for (size_t c = 0; c < 3; ++c)
                    pixel[to[c]] = finished(mapped[c][size_t(y) * size_t(spec.width) + size_t(x)]);
        });
    }

    float finished(float v) const {
        v = v > 0 ? v : 0;
        return m_encode(m_options.clamp ? std::min(v, 1.0f) : v);
    }

    void tag(ImageSpec& spec) const {
        spec.erase_attribute("chromaticities");
        spec.attribute("oiio:ColorSpace", space_of_encoding(m_options.encode));
        spec.attribute("tonemap:layer", summary.layer);
        spec.attribute("tonemap:curve", "cgtmo");
        const std::pair<const char*, const std::string&> guides[] = {
            {"tonemap:position", summary.position},
            {"tonemap:normal", summary.normal},
            {"tonemap:albedo", summary.albedo}};
        for (const auto& [name, layer] : guides)
            if (!layer.empty())
                spec.attribute(name, layer);
        spec.attribute("tonemap:adaptation", float(summary.adaptation));
        spec.attribute("tonemap:adaptation_from", summary.adaptation_from);
        spec.attribute("tonemap:maximum", float(summary.maximum));
        spec.attribute("tonemap:maximum_from", summary.maximum_from);
        if (!summary.maximum_light.empty())
            spec.attribute("tonemap:maximum_light", summary.maximum_light);
    }

    static constexpr double kLuminanceSigma = 0.4;

    const ImageBuf& m_src;
    const CgTmoOptions& m_options;
    int m_nthreads;
    ROI m_region;
    Encoding m_encode = nullptr;
    tonemap::LocalOperator m_what;
    ColorReader m_reader;
    ColorPlanes m_planes;
    GBuffer m_guides;
    bool m_half_positions = false;
    std::vector<float> m_footprints;
    kernels::GuidePlanes m_view;
};

} // namespace

bool ToneAlgo::cg_tmo(ImageBuf& dst, const ImageBuf& src, const CgTmoOptions& options,
                      CgTmoSummary* summary, ROI roi, int nthreads) {
    return guarded(dst, "cg_tmo", [&](std::string& error) {
        LocalMapping mapping(src, options, nthreads);
        if (!mapping.run(dst, roi, error))
            return false;
        if (summary)
            *summary = mapping.summary;
        return true;
    });
}

ImageBuf ToneAlgo::cg_tmo(const ImageBuf& src, const CgTmoOptions& options, CgTmoSummary* summary,
                          ROI roi, int nthreads) {
    ImageBuf dst;
    cg_tmo(dst, src, options, summary, roi, nthreads);
    return dst;
}

} // namespace tonetool
