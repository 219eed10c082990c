#include <algorithm>
#include <cmath>

#include "imagebuf/view_light.h"

namespace tonetool {
namespace {

constexpr kernels::CubeShape kRange;

} // namespace

std::unique_ptr<kernels::LightCube> bake(const LightSource& source,
                                         const kernels::CubeShape& range) {
    auto cube = std::make_unique<kernels::LightCube>(range);
    std::vector<float> levels(size_t(range.size)), row(3 * size_t(range.size));
    for (int i = 0; i < range.size; ++i)
        levels[size_t(i)] = float(cube->level(i));
    for (int r = 0; r < range.size; ++r)
        for (int g = 0; g < range.size; ++g) {
            for (size_t b = 0; b < levels.size(); ++b) {
                row[3 * b] = levels[size_t(r)];
                row[3 * b + 1] = levels[size_t(g)];
                row[3 * b + 2] = levels[b];
            }
            source(row.data(), range.size);
            cube->set_row(r, g, row.data());
        }
    return cube;
}

const kernels::LightCube& DisplayLight::State::cube() const {
    std::call_once(baking, [this] {
        baked = bake([this](float* rgb, ptrdiff_t count) { light(rgb, count); }, kRange);
    });
    return *baked;
}

kernels::ToneRows DisplayLight::baked() const {
    m_state->cube();
    return [state = m_state](const float* const in[3], float* const out[3], ptrdiff_t count,
                             float scale) {
        kernels::light_cube_rows(*state->baked, in, out, count, scale);
    };
}

} // namespace tonetool
