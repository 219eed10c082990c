// The light of a view in a table, and how far that is from the view.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "imagebuf/view_light.h"

namespace tonetool {
namespace {

// 81 vertices: HDR-FLIP of path-traced scenes under ACES SDR comes to within 4e-3 of the exact
// view, in a hundredth of its time; a table of 8.5 MB, of which coherent pixels touch little.
constexpr int kSize = 81;
constexpr double kBrightestOfPivot = 65536;
constexpr unsigned kBakingThreads = 2;
constexpr int64_t kMostSamples = 1 << 16;

// The first of these rising values whose grey shines with at least this light.
double value_with(double light, const std::vector<double>& values,
                  const std::vector<double>& greys) {
    for (size_t i = 0; i < values.size(); ++i)
        if (greys[i] >= light)
            return values[i];
    return 0;
}

// The pivot is where a grey gets to 0.3. L* of darker greys goes with a third of the power that
// their light goes with: about 1 without a toe, where cells must reach further into the dark.
kernels::CubeShape choose_shape(const DisplayLight& light) {
    kernels::CubeShape shape;
    shape.size = kSize;
    std::vector<double> values;
    for (int eighth = -128; eighth <= 128; ++eighth)
        values.push_back(std::exp2(eighth / 8.0));
    const std::vector<double> greys = light.greys(values);
    const double bright = value_with(0.3, values, greys), dark = value_with(0.003, values, greys);
    if (bright > dark && dark > values[0]) {
        shape.pivot = bright;
        shape.steep = std::log(100.0) / std::log(bright / dark) > 1.15;
    }
    shape.brightest = kBrightestOfPivot * shape.pivot;
    return shape;
}

void bake_plane(const LightSource& source, const std::vector<float>& levels, int r,
                std::vector<float>& plane, kernels::LightCube& cube) {
    const auto n = ptrdiff_t(levels.size());
    float* to = plane.data();
    for (float green : levels)
        for (float blue : levels) {
            *to++ = levels[size_t(r)];
            *to++ = green;
            *to++ = blue;
        }
    source(plane.data(), n * n);
    for (int g = 0; g < n; ++g)
        cube.set_row(r, g, plane.data() + 3 * n * g);
}

} // namespace

std::unique_ptr<kernels::LightCube> bake(const LightSource& source,
                                         const kernels::CubeShape& shape) {
    auto cube = std::make_unique<kernels::LightCube>(shape);
    std::vector<float> levels(size_t(shape.size));
    for (int i = 0; i < shape.size; ++i)
        levels[size_t(i)] = float(cube->level(i));
    std::atomic<int> next{0};
    const auto work = [&](std::vector<float> plane) {
        for (int r = next++; r < shape.size; r = next++)
            bake_plane(source, levels, r, plane, *cube);
    };
    const std::vector<float> plane(3 * levels.size() * levels.size());
    std::vector<std::thread> others;
    for (unsigned t = 1; t < std::min(kBakingThreads, std::thread::hardware_concurrency()); ++t)
        others.emplace_back(work, plane);
    work(plane);
    for (std::thread& thread : others)
        thread.join();
    return cube;
}

kernels::ToneRows DisplayLight::baked() const {
    std::call_once(m_state->baking,
                   [this] { m_state->baked = bake(source(), choose_shape(*this)); });
    return [state = m_state](const float* const in[3], float* const out[3], ptrdiff_t count,
                             float scale) {
        kernels::light_cube_rows(*state->baked, in, out, count, scale);
    };
}

BakeError measure_bake(const DisplayLight& light, const float* const planes[3], int64_t pixels,
                       const std::vector<double>& stops) {
    BakeError error;
    const int64_t all = pixels * int64_t(stops.size());
    if (all <= 0)
        return error;
    const int64_t samples = std::min(all, kMostSamples);
    const int64_t per_exposure = std::max<int64_t>(samples / int64_t(stops.size()), 1);
    const kernels::ToneRows exact = light.exact(), baked = light.baked();
    std::vector<float> in[3], a[3], b[3];
    for (auto* rgb : {in, a, b})
        for (int c = 0; c < 3; ++c)
            rgb[c].resize(size_t(per_exposure));
    for (int64_t i = 0; i < per_exposure; ++i)
        for (int c = 0; c < 3; ++c)
            in[c][size_t(i)] = planes[c][i * pixels / per_exposure];
    const float* const from[3] = {in[0].data(), in[1].data(), in[2].data()};
    float* const to_exact[3] = {a[0].data(), a[1].data(), a[2].data()};
    float* const to_baked[3] = {b[0].data(), b[1].data(), b[2].data()};
    double sum = 0;
    for (double stop : stops) {
        if (error.samples == kMostSamples)
            break;
        const auto scale = float(std::exp2(stop));
        exact(from, to_exact, per_exposure, scale);
        baked(from, to_baked, per_exposure, scale);
        for (int c = 0; c < 3; ++c)
            for (size_t i = 0; i < in[c].size(); ++i) {
                const double apart = std::abs(double(a[c][i]) - double(b[c][i]));
                error.max = std::max(error.max, apart);
                sum += apart;
            }
        error.samples += per_exposure;
    }
    error.mean = sum / (3 * double(error.samples));
    return error;
}

} // namespace tonetool
