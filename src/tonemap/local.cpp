#include "tonemap/local.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/curve_constants.h"
#include "tonemap/base.h"

namespace tonetool::tonemap {
namespace {

using kernels::ConstRgb;
using kernels::GuidePlanes;
using kernels::Window;

const double kLn2 = std::log(2.0), kLn10 = std::log(10.0);

struct Rows {
    int first, end; // of the image
};

// `y` counts from the first row of the planes.
void luminance_row(const LocalOperator& what, const ConstRgb& image, ptrdiff_t y, float* out) {
    const float* rgb[3];
    for (size_t c = 0; c < 3; ++c)
        rgb[c] = image.plane[c] + y * image.stride;
    kernels::luminance_rows(what.curve.weights, rgb, out, image.width);
}

// What is filtered, and what the luminance term compares, as planes beside the guides.
class Values {
public:
    Values(const LocalOperator& what, const ConstRgb& image, const GuidePlanes& guides,
           const Rows& rows, const kernels::ParallelFor& parallel)
        : m_planes(guides) {
        m_planes.stride = std::max<ptrdiff_t>(m_planes.stride, image.width);
        m_planes.width = image.width;
        m_planes.height = image.height;
        m_planes.first_row = image.first_row;
        const auto size = size_t(m_planes.stride) * size_t(rows.end - image.first_row);
        const bool two = !what.logarithmic && what.luminance_sigma > 0;
        m_value.resize(size);
        m_range.resize(two ? size : 0);
        parallel(rows.end - rows.first, [&](int64_t i) {
            const ptrdiff_t y = rows.first - image.first_row + i, at = y * m_planes.stride;
            fill(what, image, y, m_value.data() + at, two ? m_range.data() + at : nullptr);
        });
        m_planes.value = m_value.data();
        m_planes.range = two ? m_range.data() : what.luminance_sigma > 0 ? m_value.data() : nullptr;
    }

    const GuidePlanes& planes() const { return m_planes; }

private:
    static void fill(const LocalOperator& what, const ConstRgb& image, ptrdiff_t y, float* value,
                     float* range) {
        luminance_row(what, image, y, value);
        const auto least = float(what.least_luminance);
        if (range)
            kernels::log_rows(value, range, image.width, least, float(kLn2 / kLn10));
        if (what.logarithmic)
            kernels::log_rows(value, value, image.width, least, float(kLn2));
    }

    GuidePlanes m_planes;
    std::vector<float> m_value, m_range;
};

kernels::GuidedTerms terms_of(const LocalOperator& what) {
    kernels::GuidedTerms terms = what.terms;
    // The range of a base of natural logarithms is the base itself.
    terms.range = what.luminance_sigma * (what.logarithmic ? kLn10 : 1);
    terms.least = what.logarithmic ? std::numeric_limits<float>::lowest() : 0;
    return terms;
}

} // namespace

std::vector<float> luminance_plane(const LocalOperator& what, const ConstRgb& image,
                                   const kernels::ParallelFor& parallel) {
    std::vector<float> plane(size_t(image.width) * size_t(image.height));
    parallel(image.height, [&](int64_t y) {
        luminance_row(what, image, y - image.first_row, plane.data() + y * image.width);
    });
    return plane;
}

void guided_base(const LocalOperator& what, const ConstRgb& image, const GuidePlanes& guides,
                 const kernels::TapSets& taps, const Window& window, float* base, ptrdiff_t stride,
                 const kernels::ParallelFor& parallel) {
    if (window.width <= 0 || window.height <= 0)
        return;
    const Rows rows{std::max(0, window.y0 - taps.half()),
                    std::min(image.height, window.y0 + window.height + taps.half())};
    const Values values(what, image, guides, rows, parallel);
    filter_base(values.planes(), terms_of(what), taps, window, base, stride, parallel);
}

void local_part(const LocalOperator& what, const ConstRgb& image, const LocalBase& base,
                const Window& window, LocalPart part, float* out, ptrdiff_t stride,
                const kernels::ParallelFor& parallel) {
    parallel(window.height, [&](int64_t y) {
        std::vector<float> light(size_t(image.width));
        luminance_row(what, image, window.y0 - image.first_row + y, light.data());
        for (int x = 0; x < window.width; ++x) {
            const float l = light[size_t(window.x0) + size_t(x)],
                        b = base.plane[y * base.stride + x];
            const double linear = what.logarithmic ? std::exp(double(b)) : double(b);
            const bool split = linear >= double(kernels::kSmallestLuminance) &&
                               linear <= double(std::numeric_limits<float>::max());
            out[y * stride + x] = part == LocalPart::Base ? (split ? float(linear) : l)
                                                          : (split ? float(double(l) / linear) : 1);
        }
    });
}

void tone_map_local(const LocalOperator& what, const ConstRgb& image, const LocalBase& base,
                    const Window& window, const LocalOutput& output,
                    const kernels::ParallelFor& parallel) {
    kernels::LocalCurve curve = what.curve;
    curve.log_base = what.logarithmic;
    parallel(window.height, [&](int64_t y) {
        const ptrdiff_t at = (window.y0 - image.first_row + y) * image.stride + window.x0;
        const float* in[3];
        float* out[3];
        for (size_t c = 0; c < 3; ++c) {
            in[c] = image.plane[c] + at;
            out[c] = output.rgb[c] + y * output.stride;
        }
        kernels::local_rows(curve, base.plane + y * base.stride, in, out, window.width);
    });
}

} // namespace tonetool::tonemap
