// LDR-FLIP and HDR-FLIP of one tile, all exposures in cache, in float lanes (Google Highway).
#pragma once

#include <hwy/aligned_allocator.h>
#include <vector>

#include "kernels/flip_taps.h"
#include "kernels/tone_curve.h"
#include "kernels/views.h"

namespace tonetool::kernels {

/// Geometry of a tile in memory: `width` x `height` pixels inside a halo of `halo` pixels.
/// Every row has room for whole vectors beyond its end.
struct TileShape {
    int width = 0, height = 0, halo = 0;
    ptrdiff_t stride = 0;        ///< of planes of the tile, in floats
    ptrdiff_t padded_stride = 0; ///< of planes with the halo

    TileShape() = default;
    TileShape(int tile_width, int tile_height, int tile_halo);
    int padded_height() const { return height + 2 * halo; }
    int padded_width() const { return width + 2 * halo; }
};

using Floats = hwy::AlignedFreeUniquePtr<float[]>;

/// `count` planes of one size in one allocation.
class Planes {
public:
    Planes() = default;
    Planes(int count, ptrdiff_t stride, int rows);
    float* operator[](int i) { return m_data.get() + i * m_size; }
    const float* operator[](int i) const { return m_data.get() + i * m_size; }
    ptrdiff_t size() const { return m_size; }

private:
    Floats m_data;
    ptrdiff_t m_size = 0;
};

/// A tile of one image with its halo: linear R, G, B.
struct TilePixels {
    TilePixels(const TileShape& shape, const ConstRgb& image, int x0, int y0);
    /// Bit for bit, halo included.
    bool same_as(const TilePixels& other) const;
    Planes rgb;
};

/// What LDR-FLIP compares: Hunt-adjusted L (in two parts), a, b of the filtered image, edge and
/// point strength.
enum FeaturePlane { kLHigh, kLLow, kA, kB, kEdge, kPoint, kFeaturePlanes };

/// What the x pass leaves for the y pass: three filtered colours, the last of them twice, and the
/// luminance under the three filters of the features.
enum RowPlane { kRowY, kRowCx, kRowCz1, kRowCz2, kRowG, kRowD1, kRowD2, kRowPlanes };

/// Work space for one tile; made once per tile, reused for every exposure and image.
class FlipTile {
public:
    FlipTile(const TileShape& shape, const FlipTaps<float>& taps);

    /// Exposes, tone maps, clamps, filters one image: `features` gets kFeaturePlanes planes.
    void prepare(const TilePixels& pixels, const ToneCurve& curve, float scale, Planes& features);

    /// LDR-FLIP of two prepared images; raises `best` and writes `n` into `index` where the error
    /// is larger (strictly: the first exposure wins ties). `error`, if given, receives the error
    /// itself. All planes have the shape's stride.
    void compare(const Planes& reference, const Planes& test, float n, float* best, float* index,
                 float* error) const;

private:
    TileShape m_shape;
    const FlipTaps<float>& m_taps;
    Planes m_opponent; // y, x - y, y - z of the padded tile
    Planes m_rows;     // kRowPlanes of them
};

/// `count` pixels exposed, tone mapped and clamped; in and out may be the same.
void tone_map_pixels(const float* const in[3], float* const out[3], int64_t count,
                     const ToneCurve& curve, float scale);

/// Name of the instruction set the lanes run on.
const char* flip_tile_target();

} // namespace tonetool::kernels
