// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/tone/steady.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <memory>

#include "imagebuf/color/color_reader.h"
#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/has_pixels.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/row_source.h"
#include "imagebuf/tone/cgtmo_guides.h"
#include "imagebuf/tone/cgtmo_plan.h"
#include "imagebuf/tone/noise.h"
#include "imagebuf/tone/shot_statistics.h"
#include "metrics/refusal.h"
#include "tonetool/shot.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;
using tonemap::NoCamera;
using tonemap::SteadyPixel;

struct FoundCamera {
    std::optional<tonemap::Projection> camera;
    std::string lack; ///< why there is none
};

FoundCamera camera_of(const LocalGuides& guides) {
    if (!guides.positions_are_of_scene())
        return {{}, "no position of the scene is among the layers"};
    const kernels::GuidePlanes& image = guides.view();
    const auto fit = tonemap::fit_camera({{image.position[0], image.position[1], image.position[2]},
                                          image.background,
                                          image.width,
                                          image.height});
    switch (fit.lack) {
    case NoCamera::None:
        return {fit.camera, ""};
    case NoCamera::Few:
        return {{}, "too few pixels show a surface"};
    case NoCamera::Flat:
        return {{}, "all surfaces are in a plane, which tells no camera"};
    case NoCamera::Inexact:
        break;
    }
    return {{},
            format("no camera sees its positions where they are (99 % within {:.3g} pixels, {} are "
                   "allowed)",
                   fit.residual, tonemap::kMostResidual)};
}

int16_t in_steps_of_normal(float v) {
    return int16_t(std::lround(std::clamp(v, -1.0f, 1.0f) * tonemap::kNormalSteps));
}
uint16_t in_steps_of_albedo(float v) {
    return uint16_t(std::lround(std::clamp(v, 0.0f, 1.0f) * tonemap::kAlbedoSteps));
}

// The channels X, Y, Z, W of a layer.
std::array<int, 4> motion_channels(const ImageSpec& spec, const std::string& layer) {
    std::array<int, 4> found{};
    const char* const names[] = {"X", "Y", "Z", "W"};
    for (size_t c = 0; c < found.size(); ++c) {
        found[c] = spec.channelindex(layer + "." + names[c]);
        if (found[c] < 0)
            throw Refusal(format("there is no channel \"{}.{}\" (motion=LAYER has X, Y: where a "
                                 "surface was less where it is, Z, W: where it is less where it "
                                 "will be); channels: {}",
                                 layer, names[c], OIIO::Strutil::join(spec.channelnames, ", ")));
    }
    return found;
}

// One frame as others use it.
class FrameMaking {
public:
    FrameMaking(const ImageBuf& src, const CgTmoOptions& options, int nthreads)
        : m_src(src),
          m_options(options),
          m_nthreads(nthreads),
          m_region(part_of(src, {})),
          m_width(m_region.width()),
          m_parallel(make_parallel(nthreads)),
          m_plan(plan_local(options)),
          m_out(std::make_shared<SteadyPlanes>()) {}

    SteadyFrame make() {
        m_out->width = m_width;
        m_out->height = m_region.height();
        const ImageBuf whole = read_once(m_src, m_options, m_nthreads);
        const ImageBuf& pixels = whole.initialized() ? whole : m_src;
        const std::string layer = read_light(pixels);
        CgTmoSummary found;
        found.layer = layer;
        LocalGuides guides(m_src, pixels, m_options, m_region, m_nthreads);
        guides.read(m_plan.what, found);
        if (!m_options.motion.empty())
            read_motion(pixels);
        kernels::GuidePlanes image = guides.view();
        tonemap::take_logarithms(m_plan.what, m_light.data(), m_width, m_out->height, m_parallel);
        image.value = m_light.data();
        FoundCamera found_camera = camera_of(guides);
        m_out->camera = found_camera.camera;
        m_out->lack = std::move(found_camera.lack);
        m_out->noise = m_options.noise.empty() ? measured_noise(image, m_parallel)
                                               : noise_of_layer(pixels, m_options.noise, m_region,
                                                                image.value, m_nthreads);
        keep(image);
        return std::move(m_out);
    }

private:
    size_t count() const { return size_t(m_width) * size_t(m_out->height); }

    std::string read_light(const ImageBuf& pixels) {
        ColorReader reader;
        reader.keep_color_of_any_alpha();
        reader.open(pixels, m_options.pixels, m_region, false, m_nthreads);
        ColorPlanes planes = reader.planes();
        reader.read(m_region.ybegin, m_region.yend, planes);
        m_light = read_luminance(reader, planes, m_nthreads);
        return planes.choice.layer;
    }

    void read_motion(const ImageBuf& pixels) {
        m_out->motion.resize(count());
        const auto channels = motion_channels(pixels.spec(), m_options.motion);
        for (size_t c = 0; c < channels.size(); ++c) {
            ROI region = m_region;
            region.chbegin = channels[c];
            region.chend = channels[c] + 1;
            if (!pixels.get_pixels(region, OIIO::TypeFloat, m_out->motion.data()->data() + c,
                                   sizeof(float[4])))
                throw Refusal(
                    format("layer \"{}\" cannot be read: {}", m_options.motion, pixels.geterror()));
        }
    }

    void keep(const kernels::GuidePlanes& image) {
        SteadyPlanes& out = *m_out;
        out.has_normal = image.normal[0] != nullptr;
        out.has_albedo = image.albedo[0] != nullptr;
        out.pixels.resize(count());
        out.pixels.expect_all_written();
        if (image.background) {
            out.background.resize(count());
            std::copy_n(image.background, count(), out.background.data());
        }
        m_parallel(out.height, [&](int64_t y) {
            for (ptrdiff_t i = y * m_width; i < (y + 1) * m_width; ++i) {
                SteadyPixel& pixel = out.pixels[size_t(i)];
                pixel.value = image.value[i];
                for (size_t c = 0; c < 3; ++c) {
                    pixel.position[c] = image.position[c] ? image.position[c][i] : 0;
                    pixel.normal[c] =
                        out.has_normal ? in_steps_of_normal(image.normal[c][i]) : int16_t(0);
                    pixel.albedo[c] =
                        out.has_albedo ? in_steps_of_albedo(image.albedo[c][i]) : uint16_t(0);
                }
            }
        });
        tonemap::guided_moments(
            m_plan.what, image, taps_of(m_plan, m_options.sigma),
            {0, 0, m_width, m_region.height()},
            [&](int x0, int y, int n, const float* mean, const float* variance) {
                SteadyPixel* const pixel = &out.pixels[size_t(y) * size_t(m_width) + size_t(x0)];
                for (int x = 0; x < n; ++x) {
                    pixel[x].mean = mean[x];
                    pixel[x].variance = variance[x];
                }
            },
            m_parallel);
    }

    const ImageBuf& m_src;
    const CgTmoOptions& m_options;
    int m_nthreads;
    ROI m_region;
    int m_width;
    kernels::ParallelFor m_parallel;
    LocalPlan m_plan;
    PagedArray<float> m_light;
    std::shared_ptr<SteadyPlanes> m_out;
};

tonemap::SteadyView view_of(const SteadyPlanes& planes, int number) {
    tonemap::SteadyView view;
    view.number = number;
    view.width = planes.width;
    view.height = planes.height;
    view.pixels = planes.pixels.data();
    view.background = planes.background.empty() ? nullptr : planes.background.data();
    view.has_normal = planes.has_normal;
    view.has_albedo = planes.has_albedo;
    view.camera = planes.camera ? &*planes.camera : nullptr;
    if (!planes.motion.empty())
        view.motion = reinterpret_cast<const float(*)[4]>(planes.motion.data());
    return view;
}

std::string numbers_of(const std::vector<int>& numbers) {
    std::vector<std::string> words;
    for (const int number : numbers)
        words.push_back(std::to_string(number));
    return (numbers.size() == 1 ? "frame " : "frames ") + OIIO::Strutil::join(words, ", ");
}

// Those about the frame and itself.
std::vector<tonemap::SteadyView> frames_about(const CgTmoOptions& options) {
    std::vector<tonemap::SteadyView> views;
    std::vector<int> missing;
    for (const int number : steady_window_of(options.adapt)) {
        const auto found = options.frames.find(number);
        if (found == options.frames.end() || !found->second)
            missing.push_back(number);
        else
            views.push_back(view_of(*found->second, number));
    }
    if (!missing.empty())
        throw Refusal(format("steady=1 needs {}, which {} not given (valid: steady_frame() of "
                             "all that steady_window() names)",
                             numbers_of(missing), missing.size() == 1 ? "is" : "are"));
    return views;
}

void leave_out_without_camera(std::vector<tonemap::SteadyView>& frames, CgTmoSummary& summary) {
    std::vector<int> without;
    for (const auto& frame : frames)
        (frame.camera ? summary.steady : without).push_back(frame.number);
    frames.erase(std::remove_if(frames.begin(), frames.end(),
                                [](const auto& frame) { return !frame.camera; }),
                 frames.end());
    if (!without.empty())
        summary.warnings.push_back(
            format("steady=1: the positions of {} tell no camera: {} left out", numbers_of(without),
                   without.size() == 1 ? "it is" : "they are"));
}

} // namespace

ImageBuf read_once(const ImageBuf& src, const CgTmoOptions& options, int nthreads) {
    const ImageSpec& native = src.nativespec();
    bool floats = is_file_to_read(src) && native.nchannels == src.nchannels() &&
                  std::string(src.file_format_name()) == "openexr";
    for (int c = 0; c < native.nchannels; ++c)
        floats = floats && native.channelformat(c).is_floating_point();
    if (!floats)
        return {};
    (void)chosen_color(deciding_spec(src), options.pixels); // before it takes any time
    return copy_pixels(src, part_of(src, {}), nthreads);
}

SteadyFrame steady_frame_of(const ImageBuf& src, const CgTmoOptions& options, int nthreads) {
    return FrameMaking(src, options, nthreads).make();
}

std::optional<SteadyResult> steady_result(const CgTmoOptions& options,
                                          const tonemap::LocalOperator& what,
                                          const kernels::GuidePlanes& image,
                                          const kernels::Window& window, CgTmoSummary& summary,
                                          int nthreads) {
    std::vector<tonemap::SteadyView> frames = frames_about(options);
    const int number = options.adapt.frame.value_or(0);
    const SteadyPlanes& own = *options.frames.at(number);
    if (own.width != image.width || own.height != image.height)
        throw Refusal(format("steady=1: frame {} was given with {} x {} pixels, the image has "
                             "{} x {}",
                             number, own.width, own.height, image.width, image.height));
    if (!own.camera) {
        summary.warnings.push_back("steady=1: " + own.lack + ": the frame is made alone");
        return std::nullopt;
    }
    leave_out_without_camera(frames, summary);
    const auto at = std::find_if(frames.begin(), frames.end(),
                                 [&](const auto& frame) { return frame.number == number; });
    SteadyResult out;
    const size_t count = size_t(window.width) * size_t(window.height);
    for (PagedArray<float>* plane : {&out.base, &out.gain, &out.share})
        if (plane != &out.share || options.show == "share")
            plane->resize(count);
    tonemap::steady_base(
        frames,
        {size_t(at - frames.begin()), own.noise.data(), image.footprint, what.terms.footprint},
        *what.edges, window,
        {out.base.data(), out.gain.data(), out.share.empty() ? nullptr : out.share.data(),
         window.width},
        make_parallel(nthreads));
    return out;
}

namespace ToneAlgo {

bool steady_frame(SteadyFrame& frame, const ImageBuf& src, std::string& error,
                  const CgTmoOptions& options, int nthreads) {
    return contained(error, [&] {
        check_readable(src, "source");
        CgTmoOptions wanted = options;
        wanted.steady = true;
        frame = steady_frame_of(src, with_preset(wanted), nthreads);
    });
}

bool frame_camera(std::vector<double>& camera, const ImageBuf& src, std::string& error,
                  const CgTmoOptions& options, int nthreads) {
    return contained(error, [&] {
        check_readable(src, "source");
        CgTmoOptions o = with_preset(options);
        o.normal = o.albedo = "none";
        o.footprint = "1"; // which nothing here looks at
        o.strict = false;
        LocalGuides guides(src, src, o, part_of(src, {}), nthreads);
        CgTmoSummary found;
        found.layer = chosen_color(deciding_spec(src), o.pixels).layer;
        LocalPlan plan = plan_local(o);
        guides.read(plan.what, found);
        if (!guides.positions_are_of_scene()) // a file that cannot be read is an error all the
                                              // same
            (void)copy_pixels(src, part_of(src, {}), nthreads);
        const auto fit = camera_of(guides).camera;
        camera = fit ? std::vector<double>(fit->begin(), fit->end()) : std::vector<double>();
    });
}

} // namespace ToneAlgo
} // namespace tonetool
