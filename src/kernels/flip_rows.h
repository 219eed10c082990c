// SPDX-License-Identifier: BSD-3-Clause
// The stages of LDR-FLIP on rows, in float lanes (Google Highway): one table of functions per
// instruction set, flip_tile.h puts them together.
#pragma once

#include <array>
#include <cstddef>
#include <hwy/aligned_allocator.h>

#include "kernels/flip_taps.h"
#include "kernels/tone_curve.h"

namespace tonetool::kernels {

/// Rows of this many pixels fill whole vectors on every instruction set; rows are aligned to it.
inline constexpr ptrdiff_t kMostLanes = 16;

/// Rows that one step of the vertical filter produces.
inline constexpr int kRowBlock = 4;

/// The most vectors that one step of the horizontal filter produces.
inline constexpr int kStripStep = 8;

/// How a row of a tile lies in memory: in strips. Lane l of vector v is column l * strip + v, so
/// that the neighbours of a vector in the row are whole vectors too, and no filter needs an
/// unaligned load.
struct StripShape {
    int lanes = 0;
    int strip = 0; ///< vectors of a row, a multiple of kStripStep and at least `halo`
    int halo = 0;  ///< columns that are read beside the row

    int columns() const { return lanes * strip; }
    /// After the row follow, packed, the outer columns: those at -1, -2, ... -halo, then those at
    /// columns(), columns() + 1, ... + halo - 1.
    int outer() const { return (2 * halo + lanes - 1) / lanes * lanes; }
    ptrdiff_t pitch() const { return columns() + outer(); }
    /// Rows that are filtered along x begin with `halo` vectors, the neighbours of the first one,
    /// and go on with as many before the outer columns.
    ptrdiff_t wide_start() const { return ptrdiff_t(halo) * lanes; }
    ptrdiff_t wide_pitch() const { return pitch() + 2 * wide_start(); }
};

/// An image behind the tone curve: relative luminance y, x - y and y - z, all linear; and the steps
/// of y to the row below. YCxCz without its scale and offset: filters are linear, sum to 1.
enum OpponentPlane { kY, kXy, kYz, kStepY, kOpponentPlanes };

/// The result of the pass along y, which the pass along x filters further: three filtered colours,
/// the last of them twice, and the luminance under the three filters of the features.
enum ColumnPlane {
    kColumnY,
    kColumnCx,
    kColumnCz1,
    kColumnCz2,
    kColumnG,
    kColumnD1,
    kColumnD2,
    kColumnPlanes
};

/// The features that LDR-FLIP compares: Hunt-adjusted L, a, b of the filtered image, edge and point
/// strength. L, in two parts, lacks its factor 116 and its offset; a and b lack 116 times 5 and 116
/// times 2.
enum FeaturePlane { kLHigh, kLLow, kA, kB, kEdge, kPoint, kFeaturePlanes };

/// Work space for one row: its filtered colours, and the intermediate values of the conversion to
/// Lab.
enum WorkPlane { kFilteredY, kFilteredCx, kFilteredCz, kWorkFx, kWorkFz, kWorkPlanes };

enum TapPlane { kTapsY, kTapsCx, kTapsCz1, kTapsCz2, kTapsG, kTapsD1, kTapsD2, kTapPlanes };

/// The taps of one filter, each of them in all lanes of a vector.
struct TapList {
    const float* vectors = nullptr;
    ptrdiff_t count = 0;
};

class TapVectors {
public:
    TapVectors(const LaneTaps& taps, int lanes);
    const TapList& operator[](TapPlane p) const { return m_lists[p]; }

private:
    hwy::AlignedFreeUniquePtr<float[]> m_data;
    std::array<TapList, kTapPlanes> m_lists;
};

/// Rows of opponent planes around the first row of a block: [0] is that row, [-halo] the first one.
using RowTable = const float* const*;

struct FlipRows {
    int lanes;
    const char* name;

    /// A matrix of `rows` x `columns` with `columns` floats to a row, transposed: pixels into
    /// strips, and back.
    void (*transpose)(const float* in, ptrdiff_t rows, ptrdiff_t columns, float* out);

    /// Exposes, tone maps and clamps `count` pixels, any number of which may be written beyond. In
    /// and out may be the same.
    void (*tone_map)(const float* const rgb[3], float* const out[3], ptrdiff_t count,
                     const ToneCurve& curve, float scale);

    /// Tone maps one row into y, x - y, y - z; `step_above` gets the steps of y from the row above.
    void (*to_opponent)(const float* const rgb[3], ptrdiff_t count, const ToneCurve& curve,
                        float scale, float* const out[3], const float* y_above, float* step_above);

    /// The pass along y for kRowBlock rows, on `count` values from `from` of rows that lie as
    /// StripShape says; out[plane][row] has the value of `from` at `to`.
    void (*filter_columns)(const RowTable (&in)[kOpponentPlanes], const TapVectors& taps,
                           ptrdiff_t from, ptrdiff_t count, ptrdiff_t to,
                           float* const (&out)[kColumnPlanes][kRowBlock]);

    /// Fills the halo of wide rows and `steps`, the steps of G to the next column.
    void (*fill_halo)(const StripShape& shape, const TapVectors& taps,
                      float* const (&columns)[kColumnPlanes], float* steps);

    /// The pass along x of one row: the three colours,
    void (*filter_colors)(const StripShape& shape, const TapVectors& taps,
                          const float* const (&columns)[kColumnPlanes],
                          float* const (&out)[kWorkPlanes]);
    /// and the features, edge and point, squared.
    void (*filter_features)(const StripShape& shape, const TapVectors& taps,
                            const float* const (&columns)[kColumnPlanes], const float* steps,
                            float* edge, float* point);

    /// Turns filtered colours, which it overwrites, into Hunt-adjusted Lab (the planes kLHigh to kB
    /// of `out`), and edge and point in `out` into their square roots.
    void (*to_features)(ptrdiff_t count, float* const (&work)[kWorkPlanes],
                        float* const (&out)[kFeaturePlanes]);

    /// LDR-FLIP of one row of features; raises `best` and writes `n` into `index` where the error
    /// is larger (strictly: the first exposure wins ties). `error`, if given, receives the error.
    void (*compare_row)(const float* const (&reference)[kFeaturePlanes],
                        const float* const (&test)[kFeaturePlanes], ptrdiff_t count, float n,
                        float* const (&work)[kWorkPlanes], float* best, float* index, float* error);
};

/// The functions for the best instruction set of this machine.
const FlipRows& flip_rows();

/// `count` pixels exposed, tone mapped and clamped; in and out may be the same.
void tone_map_pixels(const float* const in[3], float* const out[3], ptrdiff_t count,
                     const ToneCurve& curve, float scale);

} // namespace tonetool::kernels
