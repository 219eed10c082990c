// The colour of an ImageBuf as planes the algorithms can run on.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <string>
#include <vector>

#include "imagebuf/colorimetry.h"
#include "imagebuf/paged_array.h"
#include "imagebuf/row_source.h"
#include "include/tonetool/pixels.h"
#include "kernels/views.h"

namespace tonetool {

/// What was found in the pixels read so far, each of them looked at once.
struct ColorCounts {
    int64_t nonfinite = 0, negative = 0;
    float largest = 0; ///< largest component
    /// Depends on the values of the negative pixels as they were before they became 0.
    uint64_t negative_digest = 0;

    void add(const ColorCounts& other);
};

/// Finite linear Rec.709 >= 0 over a band of the rows of a region, or over all of them, and what
/// had to be done to get there.
struct ColorPlanes {
    OIIO::ROI region;       ///< the whole
    int begin = 0, end = 0; ///< rows that are held
    ColorChoice choice;
    PagedArray<float> plane[3];
    PagedArray<float> alpha;       ///< empty unless asked for
    PagedArray<uint8_t> nonfinite; ///< 1 where R, G, B (or the alpha asked for) is NaN or Inf
    ColorCounts counts;
    int64_t uncovered_count = 0; ///< pixels of the region outside the data window

    int width() const { return region.width(); }
    bool whole() const { return begin == region.ybegin && end == region.yend; }
    /// Where a row begins in the planes.
    size_t at(int y) const { return size_t(y - begin) * size_t(width()); }
    kernels::ConstRgb view() const;
    /// Row `y` of the planes from column `x` on, as the kernels take it.
    void row(int x, int y, const float* (&out)[3]) const;
};

/// How errors begin: `side image "name": `, or without the name where there is none.
std::string side_name(const char* side, const OIIO::ImageBuf& image);

/// Whether an image can be looked at at all: read without error, not deep, not a volume.
bool check_readable(const OIIO::ImageBuf& image, const char* what, std::string& error);

/// The header `find_color` decides by: the image's spec with the data format of its file, which
/// tells display-encoded integers from linear floats.
OIIO::ImageSpec deciding_spec(const OIIO::ImageBuf& image);

/// Reads the colour of a region band by band. Pixels outside the data window are black (alpha 0).
/// Non-finite pixels become black and are marked, negative components become 0 and are counted.
class ColorReader {
public:
    /// Looks at the header only. The image must live as long as this does.
    bool open(const OIIO::ImageBuf& image, const PixelOptions& options, OIIO::ROI region,
              bool want_alpha, int nthreads, std::string& error);

    const ColorChoice& choice() const { return m_choice; }
    const OIIO::ROI& window() const { return m_window; }
    /// Bytes that one row of the region takes in the planes.
    size_t row_bytes() const;
    /// Read in small steps and hold nothing in between.
    void be_frugal() { m_frugal = true; }
    /// What reading so holds beside the planes while it reads, by estimate, and in between.
    size_t frugal_bytes() const;
    size_t kept_bytes() const { return m_source.kept_bytes(); }

    /// Planes that hold no row yet.
    ColorPlanes planes() const;
    /// Makes `planes` hold these rows: those that it has stay, the others are read.
    bool read(int begin, int end, ColorPlanes& planes, std::string& error);

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
        size_t place; ///< of its first pixel in the region
        void blacken(size_t from, size_t to) const;
    };

    bool fill(int begin, int end, ColorPlanes& planes, std::string& error);
    bool fill_from_file(int begin, int end, ColorPlanes& planes, std::string& error);
    bool fetch(int begin, int end, Stage& stage, std::string& error);
    void clean_row(int y, const Stage& stage, ColorPlanes& planes, ColorCounts& counts) const;
    void clean(const Row& row, size_t from, size_t to, int y, const Stage& stage,
               ColorCounts& counts) const;
    const float* staged(const Stage& stage, int y, size_t which) const;
    size_t step_bytes() const;

    struct Place {
        size_t run = 0;
        int channel = 0, stride = 0; ///< within the run; stride 0: there is no such channel
    };

    RowSource m_source;
    ColorChoice m_choice;
    ColorSpace m_space;
    OIIO::ROI m_region, m_window;
    bool m_alpha = false, m_frugal = false;
    int m_nthreads = 0;
    int64_t m_uncovered = 0;
    Place m_place[4];
    Stage m_stage;
};

/// The whole region at once.
bool read_planes(const OIIO::ImageBuf& image, const PixelOptions& options, OIIO::ROI region,
                 bool want_alpha, int nthreads, ColorPlanes& out, std::string& error);

} // namespace tonetool
