#include "imagebuf/pair.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "imagebuf/allocation.h"
#include "imagebuf/bands.h"
#include "imagebuf/oiio_compat.h"

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
    OIIO::ImageSpec spec(planes.width(), planes.region.height(), int(channels), OIIO::TypeFloat);
    spec.x = planes.region.xbegin;
    spec.y = planes.region.ybegin;
    ImageBuf image = allocated_image(spec);
    image.set_roi_full(full);
    auto* pixels = static_cast<float*>(image.localpixels());
    for (size_t i = 0; i < planes.nonfinite.size(); ++i) {
        for (size_t p = 0; p < 3; ++p)
            pixels[i * channels + p] =
                planes.nonfinite[i] ? std::numeric_limits<float>::quiet_NaN() : planes.plane[p][i];
        if (alpha)
            pixels[i * channels + 3] = planes.alpha[i];
    }
    return image;
}

int64_t pixels_of(const ColorPlanes& planes) {
    return int64_t(planes.width()) * planes.region.height();
}

// What resizing holds at most: planes and image, or images with and without holes before and after.
uint64_t resize_bytes(const ROI& from, const ROI& to, bool alpha) {
    const auto pixels = [](const ROI& r) { return uint64_t(r.width()) * uint64_t(r.height()); };
    const uint64_t pixel = (alpha ? 4 : 3) * sizeof(float);
    return std::max(pixels(from) * (2 * pixel + 1), 2 * pixel * (pixels(from) + pixels(to)));
}

bool resize_fits(const ROI& from, const ROI& to, const PairOptions& options, std::string& error) {
    const uint64_t least = kSetAside + resize_bytes(from, to, options.alpha == AlphaPolicy::Error);
    if (options.memory == 0 || least <= options.memory)
        return true;
    error = "memory is " + size_text(options.memory) +
            ": resizing takes the whole test image, which needs at least " + size_text(least);
    return false;
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

bool FittedTest::open(const ImageBuf& reference, const ImageBuf& test, const PairOptions& options,
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
        !resize(window, options, nthreads, error))
        return false;
    return compared_region(reference, *m_test, options.size, m_region, error);
}

// Only what is compared, in linear light and without its non-finite pixels, which stay what they
// are where they were instead of spreading through the filter.
bool FittedTest::resize(const ROI& window, const PairOptions& options, int nthreads,
                        std::string& error) {
    const bool alpha = options.alpha == AlphaPolicy::Error;
    ColorReader reader;
    if (!resize_fits(m_test->roi(), window, options, error))
        return false;
    if (!reader.open(*m_test, m_pixels, plane_of(m_test->roi()), alpha, nthreads, error)) {
        error = with_side(name(), error);
        return false;
    }
    if (options.memory > 0)
        reader.be_frugal();
    ColorPlanes planes = reader.planes();
    if (!reader.read(planes.region.ybegin, planes.region.yend, planes, error)) {
        error = with_side(name(), error);
        return false;
    }
    if (!fill_window(planes, window, nthreads, error))
        return false;
    m_test = &m_resized;
    m_pixels = {"", "rec709"};
    return true;
}

bool FittedTest::fill_window(const ColorPlanes& planes, ROI window, int nthreads,
                             std::string& error) {
    ImageBuf color = interleaved(planes, m_test->roi_full());
    const bool holey = planes.counts.nonfinite > 0;
    const ImageBuf with_holes = holey ? color : ImageBuf();
    window.chbegin = 0;
    window.chend = color.nchannels();
    ImageBuf holes;
    // Mending looks at pixels that it has mended: one thread, or the bits depend on the order.
    if ((holey && !IBA::fixNonFinite(color, with_holes, IBA::NONFINITE_BOX3, nullptr, {}, 1)) ||
        !oiio::resize(m_resized, color, "", window, nthreads) ||
        (holey && !IBA::resample(holes, with_holes, false, window, nthreads))) {
        error = "resizing the test image: " + color.geterror() + m_resized.geterror() +
                holes.geterror();
        return false;
    }
    for (ImageBuf::Iterator<float> p(m_resized); holey && !p.done(); ++p)
        if (std::isnan(holes.getchannel(p.x(), p.y(), 0, 0)))
            p[0] = std::numeric_limits<float>::quiet_NaN();
    return true;
}

uint64_t FittedTest::held_bytes() const {
    return m_test == &m_resized ? m_resized.spec().image_bytes() : 0;
}

bool FittedTest::open_reader(bool alpha, int nthreads, ColorReader& reader,
                             std::string& error) const {
    if (reader.open(*m_test, m_pixels, m_region, alpha, nthreads, error))
        return true;
    error = with_side(name(), error);
    return false;
}

ColorPlanes FittedTest::planes(const ColorReader& reader) const {
    ColorPlanes planes = reader.planes();
    planes.choice.layer = m_choice.layer;
    planes.choice.space = m_choice.space;
    return planes;
}

FlipSide side_of(const ColorPlanes& planes) {
    return {planes.choice.layer, planes.choice.space, planes.counts.nonfinite,
            planes.counts.negative, planes.uncovered_count};
}

void warn_of_holes(const FlipSide& side, const std::string& who,
                   std::vector<std::string>& warnings) {
    if (side.nonfinite > 0)
        warnings.push_back(std::to_string(side.nonfinite) + " pixel(s) of " + who +
                           " are NaN or Inf");
    if (side.uncovered > 0)
        warnings.push_back(std::to_string(side.uncovered) + " compared pixel(s) lie outside " +
                           who + "'s data window");
}

bool check_covered(const ColorPlanes& planes, const std::string& who, std::string& error) {
    if (planes.uncovered_count < pixels_of(planes))
        return true;
    error = who + "'s data window covers none of the compared pixels: there is nothing to compare";
    return false;
}

bool check_finite(const ColorPlanes& planes, const std::string& who, std::string& error) {
    if (planes.counts.nonfinite + planes.uncovered_count < pixels_of(planes))
        return true;
    error = who + " has no finite pixel: there is nothing to compare";
    return false;
}

int64_t mend_nonfinite(ColorPlanes& r, ColorPlanes& t, int begin, int end) {
    int64_t both = 0;
    if (r.counts.nonfinite == 0 && t.counts.nonfinite == 0)
        return both;
    for (size_t i = r.at(begin); i < r.at(end); ++i) {
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

void unmend(ColorPlanes& planes) {
    for (size_t i = 0; planes.counts.nonfinite > 0 && i < planes.nonfinite.size(); ++i)
        for (size_t p = 0; planes.nonfinite[i] && p < 3; ++p)
            planes.plane[p][i] = 0;
}

} // namespace tonetool
