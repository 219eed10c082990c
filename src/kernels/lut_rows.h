// A table of colours behind a curve: light in, light in [0,1] out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <hwy/aligned_allocator.h>

namespace tonetool::kernels {

/// The range of a cube's input. A channel x is at log2(x + offset), so that 0 has a place of its
/// own, the darkest values a straight line, and the others equal cells in each stop.
struct CubeRange {
    int size = 0;      ///< vertices along an edge
    int darkest = 0;   ///< log2 of the offset
    int brightest = 0; ///< log2 of the last vertex, behind which nothing changes

    double cells_per_stop() const { return double(size - 1) / (brightest - darkest); }
};

/// Vertices hold f(light), with which a straight line between two of them is one to the eye.
/// f is CIELAB's, continued beyond both ends of [0,1], so that an edge where light is cut off runs
/// through the middle of a cell as it should. Values below 0 are made small by the cube root of
/// what is above 0, mirrored.
double encode_light(double light);
double decode_light(double code); ///< clamped to [0,1]

class LightCube {
public:
    explicit LightCube(const CubeRange& range);

    const CubeRange& range() const { return m_range; }
    /// Input that the vertices of plane i stand for.
    double level(int i) const;
    /// Encoded R, G, B and a 0, of a multiple of 16 bytes.
    float* vertex(int r, int g, int b) { return m_data.get() + 4 * index(r, g, b); }
    const float* vertex(int r, int g, int b) const { return m_data.get() + 4 * index(r, g, b); }
    /// Light, packed RGB, of the vertices (r, g, 0) to (r, g, size - 1).
    void set_row(int r, int g, const float* light);

private:
    ptrdiff_t index(int r, int g, int b) const {
        return (ptrdiff_t(r) * m_range.size + g) * m_range.size + b;
    }

    CubeRange m_range;
    hwy::AlignedFreeUniquePtr<float[]> m_data;
};

/// `count` finite pixels >= 0, times `scale`, through the cube, tetrahedrally interpolated. Any
/// count; the planes need no alignment; in and out may be the same planes.
void light_cube_rows(const LightCube& cube, const float* const in[3], float* const out[3],
                     ptrdiff_t count, float scale);

/// The same in double precision, one pixel, plainly.
void light_cube_twin(const LightCube& cube, const double (&in)[3], double (&out)[3]);

} // namespace tonetool::kernels
