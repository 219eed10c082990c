// A reference and its tests, brought to the same pixels.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "imagebuf/planes.h"
#include "include/tonetool/flip.h"

namespace tonetool {

/// The same pixels in x and y.
bool same_window(const OIIO::ROI& a, const OIIO::ROI& b);

/// The region of a comparison: the union of the data windows, cropped where asked. False (with the
/// reason) where the display windows differ and nothing was asked, or where nothing is left.
bool compared_region(const OIIO::ImageBuf& reference, const OIIO::ImageBuf& test, SizePolicy size,
                     OIIO::ROI& region, std::string& error);

/// A test image brought to the reference's display window.
class FittedTest {
public:
    /// Checks both images, resizes the test if that was asked for, finds the region.
    bool open(const OIIO::ImageBuf& reference, const OIIO::ImageBuf& test,
              const FlipOptions& options, int nthreads, std::string& error);
    const OIIO::ROI& region() const { return m_region; }
    /// What a user must know of how the two go together.
    const std::vector<std::string>& notes() const { return m_notes; }
    bool read(bool alpha, int nthreads, ColorPlanes& planes, std::string& error) const;

private:
    bool resize(const OIIO::ROI& window, bool alpha, int nthreads, std::string& error);

    const OIIO::ImageBuf* m_test = nullptr;
    PixelOptions m_pixels;
    ColorChoice m_choice; // in the image as it came
    OIIO::ImageBuf m_resized;
    OIIO::ROI m_region;
    std::vector<std::string> m_notes;
};

/// Reads one side of a comparison; the error says which.
bool read_side(const OIIO::ImageBuf& image, const PixelOptions& options, const OIIO::ROI& region,
               bool alpha, int nthreads, const char* what, ColorPlanes& planes, std::string& error);

/// A pixel that is non-finite in one image takes the other's colour, so that the neighbourhood
/// sees no difference there; non-finite in both it stays black. Returns how many are the latter.
int64_t mend_nonfinite(ColorPlanes& reference, ColorPlanes& test);

} // namespace tonetool
