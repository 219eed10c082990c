// SPDX-License-Identifier: BSD-3-Clause
// HDR-FLIP of one tile with all exposures in cache: the row functions of flip_rows.h run over it
// from top to bottom, and no more than a few rows is kept between them.
#pragma once

#include <hwy/aligned_allocator.h>
#include <vector>

#include "kernels/flip_rows.h"
#include "kernels/views.h"

namespace tonetool::kernels {

/// `count` planes of one size in one aligned allocation, zero at first.
class Planes {
public:
    Planes() = default;
    Planes(int count, ptrdiff_t pitch, int rows);
    float* operator[](int i) { return m_data.get() + i * m_size; }
    const float* operator[](int i) const { return m_data.get() + i * m_size; }
    float* row(int plane, int y) { return m_data.get() + plane * m_size + y * m_pitch; }
    const float* row(int plane, int y) const { return m_data.get() + plane * m_size + y * m_pitch; }

private:
    hwy::AlignedFreeUniquePtr<float[]> m_data;
    ptrdiff_t m_pitch = 0, m_size = 0;
};

/// A tile of at most `width` x `height` pixels inside a halo; in memory more columns and rows, to
/// whole strips and blocks.
struct TileShape {
    StripShape strips;
    int width = 0, height = 0;

    /// `lanes` of the functions that work on it.
    TileShape(int lanes, int most_columns, int most_rows, int halo);
    int rows() const { return (height + kRowBlock - 1) / kRowBlock * kRowBlock; }
    int padded_rows() const { return rows() + 2 * strips.halo; }
};

/// Whether two images are bit for bit the same in the `width` x `height` pixels at (x0, y0) and in
/// the halo around them.
bool same_pixels(const ConstRgb& a, const ConstRgb& b, const Window& window, int halo);

/// Compares the pixels of a tile of some tests with those of the reference. An object is made once
/// and used for one tile after the other, since allocating its memory takes as long as evaluating
/// many tiles.
class FlipTile {
public:
    /// The functions must outlive the object. With `keep_each` the error of the last exposure
    /// is there, too.
    FlipTile(const FlipRows& functions, const TileShape& shape, const LaneTaps& taps, size_t tests,
             bool keep_each);

    /// The memory that such an object takes, in bytes.
    static size_t bytes(const TileShape& shape, size_t tests, bool keep_each);

    /// Begins with the tile: as many tests as the object is for, or fewer.
    void load(const Window& tile, const ConstRgb& reference,
              const std::vector<const ConstRgb*>& tests);

    /// One exposure of the reference and of all tests, by `rows` if given, else by the curve:
    /// raises the error of each where this one is larger, and writes the number `n` of the exposure
    /// there.
    void expose(const ToneCurve& curve, float scale, float n, const ToneRows& rows = {});

    enum ResultPlane { kError, kIndex, kLastError, kResultPlanes };
    /// One plane of the result of a test, `stride` floats between rows.
    void store(size_t test, ResultPlane plane, float* to, ptrdiff_t stride);

private:
    // One image: its pixels in strips; and behind the curve, in a ring, as many rows as a block
    // needs.
    struct Side {
        Planes rgb, ring;
        int next_row = 0;               // the rows before it that a block needs are in the ring
        std::vector<const float*> rows; // of the block, plane after plane
    };
    struct Test : Side {
        std::vector<int> differing; // rows before this one that differ from the reference's
        std::vector<char> shows;    // whether the row in a slot does, behind the curve
        Planes result;
    };

    struct Exposure {
        const ToneCurve& curve;
        float scale;
        const ToneRows& rows;
    };

    void make(Side& side) const;
    void load(Side& side, const ConstRgb& image);
    void pack_row(const float* in, const float* next, int width, float* out);
    void find_differing_rows(Test& test) const;
    bool same_window(const Test& test, int y) const;
    bool same_behind_curve(const Test& test) const;
    static int first_missing(const Side& side, int y);
    void show_row(Side& side, int y, const Exposure& exposure);
    void show_rows(int y, const Exposure& exposure);
    void show_rows(Test& test, int y, const Exposure& exposure);
    bool differs(Test& test, int y, const Exposure& exposure);
    void filter_columns(Side& side, int y);
    void filter_row(int row, Planes& features, int to_row);
    void filter_reference(int y);
    void compare_block(Test& test, int y, float n);

    const FlipRows& m_functions;
    TileShape m_shape;
    TapVectors m_taps;
    bool m_keep_each;
    int m_slots; // rows of the rings
    Window m_tile;
    size_t m_active = 0; // tests of this tile
    Side m_reference;
    std::vector<Test> m_tests;
    Planes m_row, m_toned, m_columns, m_steps, m_work, m_reference_features, m_test_features;
};

} // namespace tonetool::kernels
