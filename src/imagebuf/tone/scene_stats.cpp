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
#include "imagebuf/tone/counted_pixels.h"
#include "imagebuf/tone/header_light.h"
#include "imagebuf/tone/shot_statistics.h"
#include "metrics/order_statistics.h"
#include "metrics/refusal.h"
#include "tonemap/cell_mean.h"
#include "tonemap/luminance_means.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::Strutil::fmt::format;

constexpr double kEpsilon = 1e-6;
// Added to luminances that are above 0.
constexpr double kNothing = 1e-30;
// Between figures of the lights and of the image, before another unit is suspected; of a panorama
// and of the image.
constexpr double kFar = 1000, kFarMean = 4;
// What is said of a picture: more pixels than this share show nothing; the mean of all pixels is so
// many times less; more than this share is so many times above Lmax; Lmax is closer to Lwa.
constexpr double kMostlyNothing = 0.5, kOtherMean = 2, kAboveMaximum = 1e-3, kFarAbove = 4,
                 kNoRange = 2;

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
          m_lights(image, options.pixels, options.lights, *options.max_percentile, nthreads) {}

    void measure(ColorReader& reader, ColorPlanes& planes, const uint8_t* background) {
        check();
        find_shot();
        m_lights.read_table();
        read_panorama();
        m_out.luminance = read_luminance(reader, planes, m_nthreads);
        m_region = planes.region;
        const bool alpha = planes.choice.a >= 0 && !planes.alpha.empty();
        count({alpha ? planes.alpha.data() : nullptr, background});
        m_means = means_of(m_measured, lit() ? kNothing : kEpsilon);
        m_out.counted = m_means.counted;
        find_maximum();
        find_adaptation();
        compare();
        say();
    }

private:
    bool lit() const { return m_options.count == "lit"; }
    tonemap::LuminanceMeans means_of(const float* plane, double epsilon) const {
        return tonemap::luminance_means(plane, m_region.width(), m_region.height(), epsilon,
                                        make_parallel(m_nthreads));
    }
    void count(const ShownPixels& shown);
    void say() const;
    void check();
    void find_shot();
    void read_panorama();
    void find_maximum();
    void maximum_from(Source source, std::string& why);
    void take_lights(Source source, std::string& why);
    void find_adaptation();
    double camera_mean();
    double image_mean() const;
    double shot_mean() const {
        return m_options.lwa == "geometric" ? m_shot->lwa_geometric : m_shot->lwa;
    }
    double panorama_mean() const;
    double image_maximum() const;
    metrics::OrderStatistics order() const {
        return {m_measured, m_region.width(), m_region.height(), m_region.width(),
                make_parallel(m_nthreads)};
    }
    double image_percentile(metrics::Wanted wanted) const;
    bool asked(Source source) const;
    void compare();

    const ImageBuf& m_image;
    const CgTmoOptions& m_options;
    int m_nthreads;
    SceneStats& m_out;
    LightMaximum m_lights;
    std::optional<ShotExposure> m_shot; ///< what stands for the image
    std::optional<PanoramaStats> m_panorama;
    std::string m_no_panorama; ///< why it is not used
    OIIO::ROI m_region;
    CountedPixels m_counted;           ///< with count=lit
    const float* m_measured = nullptr; ///< luminances, of the pixels that count
    tonemap::LuminanceMeans m_means;   ///< of them
};

void SceneMeasure::count(const ShownPixels& shown) {
    m_measured = m_out.luminance.data();
    if (!lit())
        return;
    m_counted = counted_pixels(m_measured, m_region.width(), m_region.height(), shown,
                               make_parallel(m_nthreads));
    m_measured = m_counted.luminance.data();
    if (!m_counted.alpha_tells)
        m_out.warnings.push_back("alpha is 0 wherever there is light: it does not say which pixels "
                                 "show something");
}

void SceneMeasure::check() {
    const CgTmoOptions& o = m_options;
    if (o.method != "camera" && !number_of(o.lwa))
        check_one_of("lwa", o.lwa,
                     {"cells", "geometric", "harmonic", "arithmetic", "median", "a number"});
    if (o.lights.table.empty() && o.maximum == "lights")
        throw Refusal("maximum=lights needs a table of lights (lights=)");
    if (o.lights.table.empty() && !o.lights.layer.empty() && o.lights.layer != "groups")
        throw Refusal("lightindex= needs a table of lights (lights=)");
    const bool looks = o.maximum == "auto" || o.maximum == "first" || o.maximum == "lights";
    if (!o.lights.table.empty() && !looks)
        throw Refusal(
            format("maximum={} does not look at the table of lights (valid with it: auto, "
                   "first, lights)",
                   o.maximum));
    if (o.env.empty() && o.maximum == "env")
        throw Refusal("maximum=env needs a panorama (env=)");
}

void SceneMeasure::find_shot() {
    const bool camera = m_options.method == "camera";
    if (!camera)
        refuse_camera(m_options, m_options.method);
    if (!adapts(m_options.adapt)) {
        if (!camera)
            check_unit(m_options.adapt, "", m_options.method);
        return;
    }
    if (!ToneAlgo::measures(m_options))
        throw Refusal("adapt: nothing is measured of the image (valid: without lwa=X, lmax=X and "
                      "what stands for them)");
    if (const std::string why = ToneAlgo::not_of_shots(m_options); !why.empty())
        throw Refusal("adapt: " + why + ", or adapt=frame");
    m_shot = light_of_shot(m_options.adapt).exposure;
    if (!camera)
        check_unit(m_options.adapt, m_shot->mode, m_options.method);
    m_out.adapted = shot_words(*m_shot);
    m_out.notes = m_shot->notes;
    m_out.warnings = m_shot->warnings;
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
    const bool automatic = m_options.maximum == "auto";
    for (int i = first; i < kSources; ++i) {
        if (automatic && (i == Groups || i == Env))
            continue;
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
        m_out.maximum = source == Env ? m_panorama->max : m_shot ? m_shot->lmax : image_maximum();
    m_out.maximum_from = source == Image && m_shot ? "shot" : kSourceNames[source];
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
    const metrics::OrderStatistics sorted = order();
    return sorted.count() > 0 ? sorted.find({wanted})[0] : 0;
}

double SceneMeasure::image_maximum() const {
    if (*m_options.max_percentile >= 100)
        return m_means.max;
    return image_percentile(lit() ? maximum_of_lit(*m_options.max_percentile, m_means.counted)
                                  : metrics::Wanted::percentile(*m_options.max_percentile / 100));
}

double SceneMeasure::image_mean() const {
    if (m_options.lwa == "arithmetic")
        return m_means.arithmetic;
    if (m_options.lwa == "cells")
        return tonemap::cell_mean(m_measured, m_region.width(), m_region.height(),
                                  make_parallel(m_nthreads))
            .mean;
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

// What a camera is exposed for.
double SceneMeasure::camera_mean() {
    const OIIO::ImageSpec& spec = m_image.spec();
    const tonemap::CameraSettings camera = camera_settings(m_options, spec);
    m_out.unit = unit_or_1(m_options.adapt.unit, header_unit(spec), m_out.notes);
    m_out.ev100 = tonemap::ev100(camera);
    return tonemap::saturation_luminance(camera) * tonemap::kMeanOfSaturation / m_out.unit;
}

void SceneMeasure::find_adaptation() {
    const auto given = number_of(m_options.lwa);
    const bool camera = m_options.method == "camera";
    m_out.adaptation_from = camera       ? "camera"
                            : given      ? "lwa"
                            : m_panorama ? "env"
                            : m_shot     ? "shot"
                                         : "image";
    m_out.adaptation = camera       ? camera_mean()
                       : given      ? *given
                       : m_panorama ? panorama_mean()
                       : m_shot     ? shot_mean()
                                    : image_mean();
    if (!(m_out.adaptation > 0 && std::isfinite(m_out.adaptation)))
        throw Refusal(format("the adaptation luminance (lwa={}) is {}: must be positive and finite",
                             m_options.lwa, m_out.adaptation));
}

// Tables and panoramas in another unit, or at another exposure.
void SceneMeasure::compare() {
    const auto far = [](double a, double b, double times) {
        return b > 0 && (a > times * b || b > times * a);
    };
    if (m_out.maximum_from == "lights" && far(m_out.maximum, m_means.max, kFar))
        m_out.warnings.push_back(format("by the table light {} has {:.6g}, the brightest pixel "
                                        "{:.6g}: lightunit= brings them to one unit",
                                        m_out.maximum_light, m_out.maximum, m_means.max));
    if (m_out.adaptation_from != "env")
        return;
    if (const double own = image_mean(); far(m_out.adaptation, own, kFarMean))
        m_out.warnings.push_back(format("the {} mean of the panorama is {:.6g}, of the image {:.6g}"
                                        ": they should have one unit and one exposure",
                                        m_options.lwa == "cells" ? "geometric" : m_options.lwa,
                                        m_out.adaptation, own));
}

// What a look at the numbers would tell, but who looks.
void SceneMeasure::say() const {
    auto& warnings = m_out.warnings;
    const auto pixels = double(m_region.npixels());
    if (lit() && double(m_counted.nothing) > kMostlyNothing * pixels)
        warnings.push_back(format("{:.0f} % of the pixels show nothing and are not measured",
                                  100 * double(m_counted.nothing) / pixels));
    if (lit() && m_counted.nothing > 0 && m_out.adaptation_from == "image") {
        const double all = means_of(m_out.luminance.data(), kEpsilon).geometric;
        if (m_out.adaptation > kOtherMean * all)
            warnings.push_back(format("Lwa of all pixels would be {:.6g}, {:.3g} times less", all,
                                      m_out.adaptation / all));
    }
    if (m_out.maximum_from == "lmax" || m_out.maximum_from == "lights") {
        const auto most = float(kFarAbove * m_out.maximum);
        const auto above = std::count_if(m_measured, m_measured + m_region.npixels(),
                                         [most](float v) { return v > most; });
        if (double(above) > kAboveMaximum * pixels)
            warnings.push_back(format("{} pixels are above {} times the maximum, {:.6g}: is it in "
                                      "the image's unit?",
                                      above, kFarAbove, m_out.maximum));
    }
    if (m_out.maximum < kNoRange * m_out.adaptation)
        warnings.push_back(format("Lmax {:.6g} and Lwa {:.6g} differ by less than {}x: there is "
                                  "nothing to compress",
                                  m_out.maximum, m_out.adaptation, kNoRange));
}

} // namespace

SceneStats measure_scene(const ImageBuf& image, const CgTmoOptions& options, ColorReader& reader,
                         ColorPlanes& planes, const uint8_t* background, int nthreads) {
    SceneStats out;
    SceneMeasure(image, options, nthreads, out).measure(reader, planes, background);
    return out;
}

} // namespace tonetool
