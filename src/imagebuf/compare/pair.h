// SPDX-License-Identifier: BSD-3-Clause
// A reference and its tests, brought to the same pixels.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "imagebuf/color/color_reader.h"
#include "tonetool/compare.h"

namespace tonetool {

/// The region in x and y, of one channel.
OIIO::ROI plane_of(OIIO::ROI r);

/// Refuses pictures that their tags turn differently: they have different pixels at the same place.
void check_orientation(const OIIO::ImageBuf& reference, const OIIO::ImageBuf& test);

/// The region of a comparison: the union of the data windows, cropped where asked. A Refusal where
/// the display windows differ and nothing was asked, or where nothing is left.
OIIO::ROI compared_region(const OIIO::ImageBuf& reference, const OIIO::ImageBuf& test,
                          SizePolicy size);

/// A test image brought to the reference's display window.
class FittedTest {
public:
    /// Before open(): it is called so in errors; negative components stay what they are.
    void call(const char* who) { m_who = who; }
    void keep_negative() { m_signed = true; }
    /// Checks both images, resizes the test if that was asked for, finds the region.
    void open(const OIIO::ImageBuf& reference, const OIIO::ImageBuf& test,
              const PairOptions& options, int nthreads);
    const OIIO::ROI& region() const { return m_region; }
    /// Other pixels are to be read than it would compare by itself.
    void set_region(const OIIO::ROI& region) { m_region = region; }
    /// What a user must know of how the two go together.
    const std::vector<std::string>& notes() const { return m_notes; }
    bool resized() const { return m_test == &m_resized; }
    /// As it came.
    const OIIO::ImageBuf& image() const { return *m_came; }
    const ColorChoice& choice() const { return m_choice; }
    /// A reader of the region; valid as long as this is.
    void open_reader(bool alpha, int nthreads, ColorReader& reader) const;
    /// Planes of that reader, which say how the image was read as it came.
    ColorPlanes planes(const ColorReader& reader) const;
    /// Bytes of the resized image, 0 if there is none.
    uint64_t held_bytes() const;
    /// How errors about the test begin.
    std::string name() const { return side_name(m_who, *m_test); }

private:
    void resize(const OIIO::ROI& window, const PairOptions& options, int nthreads);
    void note_cropped(const OIIO::ROI& window);
    void fill_window(const ColorPlanes& planes, OIIO::ROI window, int nthreads);

    const char* m_who = "test";
    bool m_signed = false;
    const OIIO::ImageBuf* m_came = nullptr;
    const OIIO::ImageBuf* m_test = nullptr;
    PixelOptions m_pixels;
    ColorChoice m_choice; // in the image as it came
    OIIO::ImageBuf m_resized;
    OIIO::ROI m_region;
    std::vector<std::string> m_notes;
};

/// How an image was read, once it has been.
FlipSide side_of(const ColorPlanes& planes);
/// Sentences about the pixels that a side ("the test") lacks.
void warn_of_holes(const FlipSide& side, const std::string& who,
                   std::vector<std::string>& warnings);

/// Refuse what there is nothing of to compare: no pixels in the data window, which is known before
/// they are read, or no finite ones, once all of them have been.
void check_covered(const ColorPlanes& planes, const std::string& who);
void check_finite(const ColorPlanes& planes, const std::string& who);

/// Pixels that are non-finite in both images: whether in the same way.
struct NonfiniteBoth {
    int64_t alike = 0, unlike = 0;
};

/// Whether a pixel that is non-finite in both images is so in the same components, of the same
/// kind, and equal in the others, where these can be compared. One may be the other as half float.
bool nonfinite_alike(const ColorPlanes& reference, size_t at, const ColorPlanes& test,
                     size_t where);

/// A pixel that is non-finite in one image takes the other's colour, so that the neighbourhood
/// sees no difference there; non-finite in both it stays black. Works on rows that both hold and
/// counts the latter; once more it changes nothing.
NonfiniteBoth substitute_nonfinite(ColorPlanes& reference, ColorPlanes& test, int begin, int end);

/// Gives pixels that do not count the reference's colour and alpha, so that the neighbourhood sees
/// no difference there. Works on rows that both hold.
void take_reference(const ColorPlanes& reference, ColorPlanes& test, int begin, int end);

/// Gives the non-finite pixels of an image this value in R, G and B.
void fill_nonfinite(ColorPlanes& planes, float value);

} // namespace tonetool
