#include "imagebuf/pair.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <cmath>
#include <limits>

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
namespace IBA = OIIO::ImageBufAlgo;

std::string window_text(const ROI& r) {
    return OIIO::Strutil::fmt::format("{}x{}{:+}{:+}", r.width(), r.height(), r.xbegin, r.ybegin);
}

// Of a region that is compared at once: 32 times an 8K frame.
constexpr double kMostPixels = 1 << 30;

ROI plane_of(ROI r) {
    r.zbegin = 0;
    r.zend = 1;
    r.chbegin = 0;
    r.chend = 1;
    return r;
}

// Tags that turn or stretch the picture on a screen, but not its pixels.
std::vector<std::string> differing_tags(const OIIO::ImageSpec& reference,
                                        const OIIO::ImageSpec& test) {
    std::vector<std::string> notes;
    const auto compare = [&](const char* tag) {
        const float r = reference.get_float_attribute(tag, 1), t = test.get_float_attribute(tag, 1);
        if (r != t)
            notes.push_back(OIIO::Strutil::fmt::format(
                "{} is {} in the reference and {} in the test: compared as stored", tag, r, t));
    };
    compare("Orientation");
    compare("PixelAspectRatio");
    return notes;
}

// The planes as an image of R, G, B (and A): linear Rec.709, NaN where they are not finite.
ImageBuf interleaved(const ColorPlanes& planes, const ROI& full) {
    const bool alpha = !planes.alpha.empty();
    const size_t channels = alpha ? 4 : 3;
    OIIO::ImageSpec spec(planes.width(), planes.height(), int(channels), OIIO::TypeFloat);
    spec.x = planes.region.xbegin;
    spec.y = planes.region.ybegin;
    ImageBuf image(spec);
    image.set_roi_full(full);
    std::vector<float> pixels(planes.nonfinite.size() * channels);
    for (size_t i = 0; i < planes.nonfinite.size(); ++i) {
        for (size_t p = 0; p < 3; ++p)
            pixels[i * channels + p] =
                planes.nonfinite[i] ? std::numeric_limits<float>::quiet_NaN() : planes.plane[p][i];
        if (alpha)
            pixels[i * channels + 3] = planes.alpha[i];
    }
    image.set_pixels(image.roi(), OIIO::TypeFloat, pixels.data());
    return image;
}

} // namespace

bool same_window(const ROI& a, const ROI& b) {
    return a.xbegin == b.xbegin && a.xend == b.xend && a.ybegin == b.ybegin && a.yend == b.yend;
}

bool compared_region(const ImageBuf& reference, const ImageBuf& test, SizePolicy size, ROI& region,
                     std::string& error) {
    const ROI ref_full = reference.roi_full(), test_full = test.roi_full();
    if (size != SizePolicy::Crop && !same_window(ref_full, test_full)) {
        error = "the reference's display window is " + window_text(ref_full) + ", the test's " +
                window_text(test_full) + "; they must be the same, or ask for resize= or crop=";
        return false;
    }
    region = plane_of(OIIO::roi_union(reference.roi(), test.roi()));
    if (size == SizePolicy::Crop) {
        region = OIIO::roi_intersection(region, plane_of(ref_full));
        region = OIIO::roi_intersection(region, plane_of(test_full));
    }
    if (region.xbegin >= region.xend || region.ybegin >= region.yend) {
        error = "nothing to compare: the display windows " + window_text(ref_full) + " and " +
                window_text(test_full) + " do not overlap";
        return false;
    }
    // In double: corrupt windows overflow everything else.
    const double pixels =
        (double(region.xend) - region.xbegin) * (double(region.yend) - region.ybegin);
    if (pixels <= kMostPixels)
        return true;
    error = OIIO::Strutil::fmt::format("the union of the data windows has {} pixels, more than {}; "
                                       "crop=1 compares the display window only",
                                       pixels, kMostPixels);
    return false;
}

bool FittedTest::open(const ImageBuf& reference, const ImageBuf& test, const FlipOptions& options,
                      int nthreads, std::string& error) {
    if (!check_readable(reference, "reference", error) || !check_readable(test, "test", error))
        return false;
    m_test = &test;
    m_pixels = options.pixels;
    for (const ImageBuf* image : {&reference, &test})
        if (!ToneAlgo::find_color(deciding_spec(*image), options.pixels, m_choice, error)) {
            error = side_name(image == &test ? "test" : "reference", *image) + error;
            return false;
        }
    m_notes = differing_tags(reference.spec(), test.spec());
    const ROI window = reference.roi_full();
    if (options.size == SizePolicy::Resize && !same_window(window, test.roi_full()) &&
        !resize(window, options.alpha == AlphaPolicy::Error, nthreads, error))
        return false;
    return compared_region(reference, *m_test, options.size, m_region, error);
}

// Only what is compared, in linear light and without its non-finite pixels, which stay what they
// are where they were instead of spreading through the filter.
bool FittedTest::resize(const ROI& window, bool alpha, int nthreads, std::string& error) {
    ColorPlanes planes;
    if (!read_side(*m_test, m_pixels, m_test->roi(), alpha, nthreads, "test", planes, error))
        return false;
    ImageBuf color = interleaved(planes, m_test->roi_full());
    const ImageBuf with_holes = color;
    ROI target = window;
    target.chbegin = 0;
    target.chend = color.nchannels();
    ImageBuf holes;
    if (!IBA::fixNonFinite(color, with_holes, IBA::NONFINITE_BOX3, nullptr, {}, nthreads) ||
        !IBA::resize(m_resized, color, "", 0.0f, target, nthreads) ||
        !IBA::resample(holes, with_holes, false, target, nthreads)) {
        error = "resizing the test image: " + color.geterror() + m_resized.geterror() +
                holes.geterror();
        return false;
    }
    if (planes.nonfinite_count > 0)
        for (ImageBuf::Iterator<float> p(m_resized); !p.done(); ++p)
            if (std::isnan(holes.getchannel(p.x(), p.y(), 0, 0)))
                p[0] = std::numeric_limits<float>::quiet_NaN();
    m_test = &m_resized;
    m_pixels = {"", "rec709"};
    return true;
}

bool FittedTest::read(bool alpha, int nthreads, ColorPlanes& planes, std::string& error) const {
    if (!read_side(*m_test, m_pixels, m_region, alpha, nthreads, "test", planes, error))
        return false;
    planes.choice.layer = m_choice.layer;
    planes.choice.space = m_choice.space;
    return true;
}

bool read_side(const ImageBuf& image, const PixelOptions& options, const ROI& region, bool alpha,
               int nthreads, const char* what, ColorPlanes& planes, std::string& error) {
    if (read_planes(image, options, region, alpha, nthreads, planes, error))
        return true;
    error = side_name(what, image) + error;
    return false;
}

int64_t mend_nonfinite(ColorPlanes& r, ColorPlanes& t) {
    int64_t both = 0;
    if (r.nonfinite_count == 0 && t.nonfinite_count == 0)
        return both;
    for (size_t i = 0; i < r.nonfinite.size(); ++i) {
        if (r.nonfinite[i] == t.nonfinite[i]) {
            both += r.nonfinite[i];
            continue;
        }
        ColorPlanes& bad = r.nonfinite[i] ? r : t;
        const ColorPlanes& good = r.nonfinite[i] ? t : r;
        for (size_t p = 0; p < 3; ++p)
            bad.plane[p][i] = good.plane[p][i];
    }
    return both;
}

} // namespace tonetool
