// SPDX-License-Identifier: BSD-3-Clause
// The light of a view in a table, and how far that is from the view.
#include <algorithm>
#include <cmath>
#include <thread>

#include "imagebuf/color/view_light.h"
#include "imagebuf/pixels/tasks.h"

namespace tonetool {
namespace {

// 81 vertices: HDR-FLIP of path-traced scenes under ACES SDR comes to within 4e-3 of the exact
// view, in a hundredth of its time; a table of 8.5 MB, of which coherent pixels touch little.
constexpr int kSize = 81;
constexpr double kBrightestOfPivot = 65536;
constexpr unsigned kBakingThreads = 2;

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
                kernels::LightCube& cube) {
    const auto n = ptrdiff_t(levels.size());
    std::vector<float> plane(3 * levels.size() * levels.size());
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
    on_own_threads(shape.size, int(std::min(kBakingThreads, std::thread::hardware_concurrency())),
                   [&](int64_t r) { bake_plane(source, levels, int(r), *cube); });
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

} // namespace tonetool
