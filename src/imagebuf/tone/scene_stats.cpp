// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/tone/scene_stats.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/lights/light_maximum.h"
#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/parallel.h"
#include "metrics/order_statistics.h"
#include "metrics/refusal.h"
#include "tonemap/luminance_means.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::Strutil::fmt::format;

constexpr double kEpsilon = 1e-6;
// Between figures of the scene and of the image, before another unit is suspected.
constexpr double kFar = 1000;

enum Source { Lights, Groups, Env, Image, kSources };
constexpr const char* kSourceNames[kSources] = {"lights", "groups", "env", "image"};
constexpr const char* kSourceTitles[kSources] = {"the lights", "the light groups", "the panorama",
                                                 "the image"};

class SceneMeasure {
public:
    SceneMeasure(const ImageBuf& image, const CgTmoOptions& options, int nthreads, SceneStats& out)
        : m_image(image),
          m_options(options),
          m_nthreads(nthreads),
          m_out(out),
          m_lights(image, options.pixels, options.lights, options.max_percentile, nthreads) {}

    void measure(ColorReader& reader, ColorPlanes& planes) {
        check();
        m_lights.read_table();
        read_panorama();
        m_out.luminance = read_luminance(reader, planes, m_nthreads);
        m_region = planes.region;
        m_means = tonemap::luminance_means(m_out.luminance.data(), m_region.width(),
                                           m_region.height(), kEpsilon, make_parallel(m_nthreads));
        find_maximum();
        find_adaptation();
        compare();
    }

private:
    void check();
    void read_panorama();
    void find_maximum();
    void maximum_from(Source source, std::string& why);
    void take_lights(Source source, std::string& why);
    void find_adaptation();
    double image_mean() const;
    double panorama_mean() const;
    double image_maximum() const;
    double image_percentile(metrics::Wanted wanted) const;
    bool asked(Source source) const;
    void compare();

    const ImageBuf& m_image;
    const CgTmoOptions& m_options;
    int m_nthreads;
    SceneStats& m_out;
    LightMaximum m_lights;
    std::optional<PanoramaStats> m_panorama;
    std::string m_no_panorama; ///< why it is not used
    OIIO::ROI m_region;
    tonemap::LuminanceMeans m_means; ///< of the image
};

void SceneMeasure::check() {
    const CgTmoOptions& o = m_options;
    if (!number_of(o.lwa))
        check_one_of("lwa", o.lwa, {"geometric", "harmonic", "arithmetic", "median", "a number"});
    if (o.lights.table.empty() && o.maximum == "lights")
        throw Refusal("maximum=lights needs a table of lights (lights=)");
    if (o.lights.table.empty() && !o.lights.layer.empty() && o.lights.layer != "groups")
        throw Refusal("lightindex= needs a table of lights (lights=)");
    if (!o.lights.table.empty() && o.maximum != "auto" && o.maximum != "lights")
        throw Refusal(
            format("maximum={} does not look at the table of lights (valid with it: auto, "
                   "lights)",
                   o.maximum));
    if (o.env.empty() && o.maximum == "env")
        throw Refusal("maximum=env needs a panorama (env=)");
}

void SceneMeasure::read_panorama() {
    const std::string& file = m_options.env;
    if (file.empty())
        return;
    const auto fail = [&](const std::string& why) {
        throw Refusal(format("panorama \"{}\": {}", file, why));
    };
    if (!OIIO::Filesystem::exists(file))
        fail("there is no such file");
    const ImageBuf image(file);
    PanoramaOptions options{m_options.pixels, m_options.weight};
    ColorChoice choice;
    std::string why;
    // It need not have the layer that was named for the image.
    if (!image.has_error() &&
        !ToneAlgo::find_color(deciding_spec(image), options.pixels, choice, why))
        options.pixels.layer.clear();
    PanoramaStats stats;
    if (!ToneAlgo::panorama_stats(stats, image, why, options, m_nthreads))
        fail(why);
    if (stats.nonfinite + stats.uncovered > 0)
        m_out.warnings.push_back(format("{} pixel(s) of the panorama are not finite or not there, "
                                        "and are left out",
                                        stats.nonfinite + stats.uncovered));
    if (stats.max > 0)
        m_panorama = stats;
    else
        m_no_panorama = format("panorama \"{}\" is black", file);
    if (m_panorama)
        return;
    if (m_options.strict)
        throw Refusal(m_no_panorama);
    m_out.warnings.push_back(m_no_panorama + " and is left out");
}

bool SceneMeasure::asked(Source source) const {
    return m_options.maximum == kSourceNames[source] ||
           (source == Lights && !m_options.lights.table.empty());
}

void SceneMeasure::find_maximum() {
    if (m_options.lmax) {
        m_out.maximum = *m_options.lmax;
        m_out.maximum_from = "lmax";
        return;
    }
    int first = 0;
    for (int i = 0; i < kSources; ++i)
        first = m_options.maximum == kSourceNames[i] ? i : first;
    std::vector<std::string> missed;
    for (int i = first; i < kSources; ++i) {
        std::string why;
        maximum_from(Source(i), why);
        if (m_out.maximum > 0) {
            for (const std::string& reason : missed)
                m_out.warnings.push_back(reason + ": the maximum is that of " + kSourceTitles[i]);
            return;
        }
        if (!why.empty() && m_options.strict && asked(Source(i)))
            throw Refusal(why);
        if (!why.empty() && (asked(Source(i)) || i == Groups))
            missed.push_back(why);
    }
    throw Refusal("the image is black: there is nothing to tone map (or pass lmax)");
}

void SceneMeasure::maximum_from(Source source, std::string& why) {
    if (source == Lights || source == Groups) {
        if (source == Groups || !m_options.lights.table.empty())
            take_lights(source, why);
        return;
    }
    if (source == Env && !m_panorama)
        why = m_no_panorama;
    else
        m_out.maximum = source == Env ? m_panorama->max : image_maximum();
    m_out.maximum_from = kSourceNames[source];
}

void SceneMeasure::take_lights(Source source, std::string& why) {
    const auto found = source == Lights ? m_lights.by_table(why) : m_lights.by_groups(why);
    if (!found) {
        // Only who asks for groups hears that there are none.
        if (!asked(source))
            why.clear();
        return;
    }
    if (!found->additive && !asked(source)) {
        why = found->warnings.back();
        return;
    }
    if (m_options.strict && !found->lacks.empty())
        throw Refusal(found->lacks.front());
    for (const auto* list : {&found->lacks, &found->warnings})
        m_out.warnings.insert(m_out.warnings.end(), list->begin(), list->end());
    m_out.maximum = found->luminance;
    m_out.maximum_from = found->measured ? "groups" : "lights";
    m_out.maximum_light = found->light;
    m_out.light_index = found->index;
}

double SceneMeasure::image_percentile(metrics::Wanted wanted) const {
    const metrics::OrderStatistics order(m_out.luminance.data(), m_region.width(),
                                         m_region.height(), m_region.width(),
                                         make_parallel(m_nthreads));
    return order.count() > 0 ? order.find({wanted})[0] : 0;
}

double SceneMeasure::image_maximum() const {
    if (m_options.max_percentile >= 100)
        return m_means.max;
    return image_percentile(metrics::Wanted::percentile(m_options.max_percentile / 100));
}

double SceneMeasure::image_mean() const {
    if (m_options.lwa == "arithmetic")
        return m_means.arithmetic;
    if (m_options.lwa == "median")
        return image_percentile(metrics::Wanted::rank(m_means.counted / 2));
    return m_options.lwa == "harmonic" ? m_means.harmonic : m_means.geometric;
}

double SceneMeasure::panorama_mean() const {
    if (m_options.lwa == "arithmetic")
        return m_panorama->mean;
    if (m_options.lwa == "median")
        return m_panorama->median;
    return m_options.lwa == "harmonic" ? m_panorama->harmonic : m_panorama->geometric;
}

void SceneMeasure::find_adaptation() {
    const auto given = number_of(m_options.lwa);
    m_out.adaptation_from = given ? "lwa" : m_panorama ? "env" : "image";
    m_out.adaptation = given ? *given : m_panorama ? panorama_mean() : image_mean();
    if (!(m_out.adaptation > 0 && std::isfinite(m_out.adaptation)))
        throw Refusal(format("the adaptation luminance (lwa={}) is {}: must be positive and finite",
                             m_options.lwa, m_out.adaptation));
}

// Tables and panoramas in another unit, or at another exposure.
void SceneMeasure::compare() {
    const auto far = [](double a, double b) { return b > 0 && (a > kFar * b || b > kFar * a); };
    if (m_out.maximum_from == "lights" && far(m_out.maximum, m_means.max))
        m_out.warnings.push_back(format("by the table light {} has {:.6g}, the brightest pixel "
                                        "{:.6g}: lightunit= brings them to one unit",
                                        m_out.maximum_light, m_out.maximum, m_means.max));
    if (m_out.adaptation_from != "env")
        return;
    if (const double own = image_mean(); far(m_out.adaptation, own))
        m_out.warnings.push_back(format("the {} mean of the panorama is {:.6g}, of the image {:.6g}"
                                        ": they should have one unit and one exposure",
                                        m_options.lwa, m_out.adaptation, own));
}

} // namespace

SceneStats measure_scene(const ImageBuf& image, const CgTmoOptions& options, ColorReader& reader,
                         ColorPlanes& planes, int nthreads) {
    SceneStats out;
    SceneMeasure(image, options, nthreads, out).measure(reader, planes);
    return out;
}

} // namespace tonetool
