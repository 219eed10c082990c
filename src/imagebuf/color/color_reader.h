// SPDX-License-Identifier: BSD-3-Clause
// From the rows of an ImageBuf to planes of colour.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cfloat>
#include <cstdint>
#include <string>
#include <vector>

#include "imagebuf/color/color_source.h"
#include "imagebuf/pixels/planes.h"
#include "imagebuf/pixels/row_source.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// Reads the colour of a region band by band. Pixels outside the data window are black (alpha 0).
/// Non-finite pixels become black and are marked, negative components become 0 and are counted.
class ColorReader {
public:
    /// Alpha, where it is not asked for, is told from another by ColorCounts::alpha_digest; before
    /// open().
    void watch_alpha() { m_watch = true; }
    /// An alpha that is not finite is 0 and leaves the colour what it is; before open().
    void keep_color_of_any_alpha() { m_any_alpha = true; }
    /// Pixels that are not finite hold what is shown of them, see light_to_show(), and not black;
    /// before open(). They are flagged all the same.
    void keep_infinities() { m_keep_infinities = true; }
    /// Negative components stay what they are; before open().
    void keep_negative() { m_least = -FLT_MAX; }
    /// Pixels that do not count are in no count, and finite: black, or if `keep` their colour,
    /// where they have one; before open(). Null: all count.
    void ignore(const IgnoredPixels* ignored, bool keep = false) {
        m_ignored = ignored;
        m_keep_ignored = keep;
    }
    /// Looks at the header only. The image must live as long as this does.
    void open(const OIIO::ImageBuf& image, const PixelOptions& options, OIIO::ROI region,
              bool want_alpha, int nthreads);

    const ColorChoice& choice() const { return m_choice; }
    const OIIO::ROI& window() const { return m_window; }
    /// Bytes that one row of the region takes in the planes.
    size_t row_bytes() const;
    /// Read in small steps and hold nothing in between.
    void save_memory() { m_saving_memory = true; }
    /// What reading so holds beside the planes while it reads, by estimate, and in between.
    size_t bytes_while_saving() const;
    size_t kept_bytes() const { return m_source.kept_bytes(); }

    /// Planes that hold no row yet.
    ColorPlanes planes() const;
    /// Makes `planes` hold these rows: those that it has stay, the others are read.
    void read(int begin, int end, ColorPlanes& planes);

private:
    // Rows as they come from the source, one buffer per run of channels.
    struct Stage {
        int begin = 0;
        std::vector<std::vector<float>> runs;
    };

    // A row of the planes.
    struct Row {
        float* plane[3];
        float* alpha; ///< may be null
        uint8_t* nonfinite;
        uint64_t* beside;
        size_t place; ///< of its first pixel in the region
        void blacken(size_t from, size_t to) const;
    };

    void fill(int begin, int end, ColorPlanes& planes);
    void fill_from_file(int begin, int end, ColorPlanes& planes);
    void fetch(int begin, int end, Stage& stage);
    void clean_row(int y, const Stage& stage, ColorPlanes& planes, ColorCounts& counts) const;
    void clean(const Row& row, size_t from, size_t to, int y, const Stage& stage,
               ColorCounts& counts) const;
    void clean_some(const Row& row, size_t from, size_t to, int y, const Stage& stage,
                    ColorCounts& counts) const;
    void count_pixels();
    void clean_pixel(const Row& row, size_t x, const float (&stored)[3], const float* alpha,
                     const float* converted, ColorCounts& counts) const;
    std::vector<float> convert(const float* const (&in)[3], const size_t (&step)[3],
                               size_t count) const;
    const float* staged(const Stage& stage, int y, size_t which) const;

    struct Place {
        size_t run = 0;
        int channel = 0, stride = 0; ///< within the run; stride 0: there is no such channel
    };

    RowSource m_source;
    ColorChoice m_choice;
    ColorSpace m_space;
    OIIO::ROI m_region, m_window;
    bool m_alpha = false, m_watch = false, m_any_alpha = false, m_keep_infinities = false,
         m_saving_memory = false, m_keep_ignored = false;
    float m_least = 0; ///< of a component
    int m_nthreads = 0;
    const IgnoredPixels* m_ignored = nullptr;
    int64_t m_counted = 0, m_uncovered = 0;
    Place m_place[4];
    Stage m_stage;
};

/// The whole region at once.
ColorPlanes read_planes(const OIIO::ImageBuf& image, const PixelOptions& options, OIIO::ROI region,
                        bool want_alpha, int nthreads);

} // namespace tonetool
