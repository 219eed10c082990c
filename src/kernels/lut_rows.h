// SPDX-License-Identifier: BSD-3-Clause
// A 3D LUT behind a shaper curve: scene light in, display light in [0,1] out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <hwy/aligned_allocator.h>

namespace tonetool::kernels {

/// Where a channel x is along an edge of a cube: x^p / (x^p + pivot^p), as eyes and film respond
/// to light (Naka and Rushton 1966). 0 is the first vertex, most cells are within a few stops of
/// the pivot, and both ends run out into the dark and the bright. Roots and a quotient, so that
/// every instruction set gets the same bits.
struct CubeShape {
    int size = 65;              ///< vertices along an edge, 2 to 128
    double pivot = 0.5;         ///< in the middle of the edge
    bool steep = true;          ///< p is 3/4, else 1/2
    double brightest = 32768.0; ///< the last vertex, behind which nothing changes
};

/// Vertices hold f(light), with which a straight line between two of them is one to the eye. f is
/// CIELAB's, continued beyond 1, and mirrored below 0: the edge where light is cut off runs through
/// the middle of a cell as it should. Cut off far outside.
double encode_light(double light);
double decode_light(double code); ///< clamped to [0,1]

class LightCube {
public:
    explicit LightCube(const CubeShape& shape);

    const CubeShape& shape() const { return m_shape; }
    /// x^p / (x^p + pivot^p).
    double share(double x) const;
    /// The position of an input in units of cells, and the input that the vertices of plane i stand
    /// for.
    double place(double x) const;
    double level(int i) const;
    /// Encoded R, G, B and a 0, of a multiple of 16 bytes.
    float* vertex(int r, int g, int b) { return m_data.get() + 4 * index(r, g, b); }
    const float* vertex(int r, int g, int b) const { return m_data.get() + 4 * index(r, g, b); }
    /// Light, packed RGB, of the vertices (r, g, 0) to (r, g, size - 1).
    void set_row(int r, int g, const float* light);

private:
    ptrdiff_t index(int r, int g, int b) const {
        return (ptrdiff_t(r) * m_shape.size + g) * m_shape.size + b;
    }

    CubeShape m_shape;
    hwy::AlignedFreeUniquePtr<float[]> m_data;
};

/// `count` finite pixels >= 0, times `scale`, through the cube, tetrahedrally interpolated. Any
/// count; the planes need no alignment; in and out may be the same planes.
void light_cube_rows(const LightCube& cube, const float* const in[3], float* const out[3],
                     ptrdiff_t count, float scale);

/// The reference implementation for one pixel, in double precision.
void light_cube_reference(const LightCube& cube, const double (&in)[3], double (&out)[3]);

} // namespace tonetool::kernels
