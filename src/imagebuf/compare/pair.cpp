// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/compare/pair.h"

#include <Imath/half.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "imagebuf/aov/channels.h"
#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/bands.h"
#include "imagebuf/pixels/ignored_pixels.h"
#include "imagebuf/pixels/layer_name.h"
#include "imagebuf/pixels/names.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "imagebuf/pixels/upright.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
namespace IBA = OIIO::ImageBufAlgo;

std::string window_text(const ROI& r) {
    return OIIO::Strutil::fmt::format("{}x{}{:+}{:+}", r.width(), r.height(), r.xbegin, r.ybegin);
}

// Of a region that is compared at once: 32 times an 8K frame.
constexpr double kMostComparedPixels = 1 << 30;

// A tag that stretches the picture on a screen, but not its pixels.
std::vector<std::string> differing_tags(const OIIO::ImageSpec& reference,
                                        const OIIO::ImageSpec& test) {
    const char* const tag = "PixelAspectRatio";
    const float r = reference.get_float_attribute(tag, 1), t = test.get_float_attribute(tag, 1);
    if (r == t)
        return {};
    return {OIIO::Strutil::fmt::format(
        "{} is {} in the reference and {} in the test: compared as stored", tag, r, t)};
}

std::string last_word(const std::string& layer) {
    return lower(layer.substr(layer.rfind('.') + 1));
}

// Whether two layers are the same by their names: renderers have their own for the beauty.
bool alike(const std::string& a, const std::string& b) {
    const auto beauty = [](const std::string& name) {
        return name.empty() || is_beauty_name(name);
    };
    return last_word(a) == last_word(b) || (beauty(a) && beauty(b));
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

// What resizing holds at most: planes and image, or images with and without holes before and after.
uint64_t resize_bytes(const ROI& from, const ROI& to, bool alpha) {
    const auto pixels = [](const ROI& r) { return uint64_t(r.width()) * uint64_t(r.height()); };
    const uint64_t pixel = (alpha ? 4 : 3) * sizeof(float);
    return std::max(pixels(from) * (2 * pixel + 1), 2 * pixel * (pixels(from) + pixels(to)));
}

// The finite components beside those that are not (ColorPlanes::beside): two floats, or a hash.
bool same_numbers(uint64_t a, uint64_t b) {
    if (a == b)
        return true;
    const auto same = [](uint64_t x, uint64_t y) {
        const auto bits_x = uint32_t(x), bits_y = uint32_t(y);
        float v = 0, w = 0;
        std::memcpy(&v, &bits_x, sizeof v);
        std::memcpy(&w, &bits_y, sizeof w);
        return v == w || float(Imath::half(v)) == w || v == float(Imath::half(w));
    };
    return same(a >> 32, b >> 32) && same(a, b);
}

void check_resize_fits(const ROI& from, const ROI& to, const PairOptions& options) {
    const uint64_t least = kSetAside + resize_bytes(from, to, options.alpha == AlphaPolicy::Error);
    if (options.memory > 0 && least > options.memory)
        throw Refusal("memory is " + size_text(options.memory) +
                      ": resizing takes the whole test image, which needs at least " +
                      size_text(least));
}

} // namespace

ROI plane_of(ROI r) {
    r.zbegin = 0;
    r.zend = 1;
    r.chbegin = 0;
    r.chend = 1;
    return r;
}

void check_orientation(const ImageBuf& reference, const ImageBuf& test) {
    const int r = orientation_of(reference.spec()), t = orientation_of(test.spec());
    if (r != t)
        throw Refusal(OIIO::Strutil::fmt::format("the Orientation of the reference is {}, that of "
                                                 "the test {}: the pictures are not turned "
                                                 "alike; turn them upright first (--autoorient "
                                                 "before the files, --reorient behind one, or "
                                                 "ImageBufAlgo::reorient)",
                                                 r, t));
}

ROI compared_region(const ImageBuf& reference, const ImageBuf& test, SizePolicy size) {
    const ROI ref_full = reference.roi_full(), test_full = test.roi_full();
    if (size != SizePolicy::Crop && !same_window(ref_full, test_full))
        throw Refusal("the reference's display window is " + window_text(ref_full) +
                      ", the test's " + window_text(test_full) +
                      "; they must be the same, or ask for resize=1 or crop=1");
    ROI region = plane_of(OIIO::roi_union(reference.roi(), test.roi()));
    if (size == SizePolicy::Crop) {
        region = OIIO::roi_intersection(region, plane_of(ref_full));
        region = OIIO::roi_intersection(region, plane_of(test_full));
    }
    if (region.xbegin >= region.xend || region.ybegin >= region.yend)
        throw Refusal("nothing to compare: the display windows " + window_text(ref_full) + " and " +
                      window_text(test_full) + " do not overlap");
    // In double: corrupt windows overflow everything else.
    const double pixels =
        (double(region.xend) - region.xbegin) * (double(region.yend) - region.ybegin);
    if (!(pixels <= kMostComparedPixels))
        throw Refusal(
            OIIO::Strutil::fmt::format("the union of the data windows has {} pixels, more than {}; "
                                       "crop=1 compares the display window only",
                                       pixels, kMostComparedPixels));
    return region;
}

void FittedTest::open(const ImageBuf& reference, const ImageBuf& test, const PairOptions& options,
                      int nthreads) {
    check_readable(reference, "reference");
    check_readable(test, m_who);
    m_test = m_came = &test;
    m_pixels = options.pixels;
    ColorChoice of_reference;
    for (const ImageBuf* image : {&reference, &test}) {
        of_reference = m_choice;
        m_choice = of_side(side_name(image == &test ? m_who : "reference", *image),
                           [&] { return chosen_color(deciding_spec(*image), options.pixels); });
    }
    // One that lost its other channels would pass where colours are pale.
    if (of_reference.grey() != m_choice.grey()) {
        const bool lost = m_choice.grey();
        throw Refusal(
            side_name(lost ? m_who : "reference", lost ? test : reference) +
            "has one channel, the other image has R,G,B: a grey picture is compared with a grey "
            "one (--ch Y,Y,Y makes three channels of it)");
    }
    check_orientation(reference, test);
    m_notes = differing_tags(reference.spec(), test.spec());
    if (!alike(of_reference.layer, m_choice.layer))
        m_notes.push_back("the layer of the reference is " + shown_layer(of_reference.layer) +
                          ", that of the test " + shown_layer(m_choice.layer));
    const ROI window = reference.roi_full();
    if (options.size == SizePolicy::Resize && !same_window(window, test.roi_full()))
        resize(window, options, nthreads);
    m_region = compared_region(reference, *m_test, options.size);
    note_cropped(window);
}

// A crop is asked for, but hardly one that leaves most of the picture out.
void FittedTest::note_cropped(const ROI& window) {
    const double compared = double(m_region.width()) * m_region.height();
    const double whole = double(window.width()) * window.height();
    if (compared < whole / 2)
        m_notes.push_back(OIIO::Strutil::fmt::format(
            "only {} of the {} pixels of the reference's display window are compared", compared,
            whole));
}

// Only what is compared, in linear light and without its non-finite pixels, which stay what they
// are where they were instead of spreading through the filter.
void FittedTest::resize(const ROI& window, const PairOptions& options, int nthreads) {
    const bool alpha = options.alpha == AlphaPolicy::Error;
    ColorReader reader;
    check_resize_fits(m_test->roi(), window, options);
    if (m_signed)
        reader.keep_negative();
    of_side(name(),
            [&] { reader.open(*m_test, m_pixels, plane_of(m_test->roi()), alpha, nthreads); });
    if (options.memory > 0)
        reader.save_memory();
    ColorPlanes planes = reader.planes();
    of_side(name(), [&] { reader.read(planes.region.ybegin, planes.region.yend, planes); });
    fill_window(planes, window, nthreads);
    m_test = &m_resized;
    m_pixels = {"", "rec709"};
}

void FittedTest::fill_window(const ColorPlanes& planes, ROI window, int nthreads) {
    ImageBuf color = interleaved(planes, m_test->roi_full());
    const bool holey = planes.counts.nonfinite > 0;
    const ImageBuf with_holes = holey ? color : ImageBuf();
    window.chbegin = 0;
    window.chend = color.nchannels();
    ImageBuf holes;
    // Substitutes are taken from neighbours that may be substitutes themselves: one thread, or the
    // bits depend on the order.
    if ((holey && !IBA::fixNonFinite(color, with_holes, IBA::NONFINITE_BOX3, nullptr, {}, 1)) ||
        !oiio::resize(m_resized, color, "", window, nthreads) ||
        (holey && !IBA::resample(holes, with_holes, false, window, nthreads)))
        throw Refusal("resizing the test image: " + color.geterror() + m_resized.geterror() +
                      holes.geterror());
    for (ImageBuf::Iterator<float> p(m_resized); holey && !p.done(); ++p)
        if (std::isnan(holes.getchannel(p.x(), p.y(), 0, 0)))
            p[0] = std::numeric_limits<float>::quiet_NaN();
}

uint64_t FittedTest::held_bytes() const {
    return resized() ? m_resized.spec().image_bytes() : 0;
}

void FittedTest::open_reader(bool alpha, int nthreads, ColorReader& reader) const {
    if (m_signed)
        reader.keep_negative();
    of_side(name(), [&] { reader.open(*m_test, m_pixels, m_region, alpha, nthreads); });
}

ColorPlanes FittedTest::planes(const ColorReader& reader) const {
    ColorPlanes planes = reader.planes();
    planes.choice.layer = m_choice.layer;
    planes.choice.space = m_choice.space;
    planes.choice.display_encoded = m_choice.display_encoded;
    planes.knows_kinds = !resized();
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

void check_covered(const ColorPlanes& planes, const std::string& who) {
    if (planes.uncovered_count >= planes.counted)
        throw Refusal(
            who + "'s data window covers none of the compared pixels: there is nothing to compare");
}

void check_finite(const ColorPlanes& planes, const std::string& who) {
    if (planes.counts.nonfinite + planes.uncovered_count >= planes.counted)
        throw Refusal(who + " has no finite pixel: there is nothing to compare");
}

bool nonfinite_alike(const ColorPlanes& r, size_t at, const ColorPlanes& t, size_t where) {
    if (!r.knows_kinds || !t.knows_kinds)
        return true;
    if (r.nonfinite[at] != t.nonfinite[where])
        return false;
    const bool has_alpha = !r.alpha.empty() && !t.alpha.empty();
    if (has_alpha && r.alpha[at] != t.alpha[where])
        return false;
    const bool one_space =
        r.choice.space == t.choice.space && r.choice.display_encoded == t.choice.display_encoded;
    return !one_space || same_numbers(r.beside[at], t.beside[where]);
}

NonfiniteBoth substitute_nonfinite(ColorPlanes& r, ColorPlanes& t, int begin, int end) {
    NonfiniteBoth both;
    if (r.counts.nonfinite == 0 && t.counts.nonfinite == 0)
        return both;
    for (size_t i = r.at(begin); i < r.at(end); ++i) {
        if (!r.nonfinite[i] && !t.nonfinite[i])
            continue;
        if (r.nonfinite[i] && t.nonfinite[i]) {
            ++(nonfinite_alike(r, i, t, i) ? both.alike : both.unlike);
            continue;
        }
        ColorPlanes& bad = r.nonfinite[i] ? r : t;
        const ColorPlanes& good = r.nonfinite[i] ? t : r;
        for (size_t p = 0; p < 3; ++p)
            bad.plane[p][i] = good.plane[p][i];
    }
    return both;
}

void take_reference(const ColorPlanes& r, ColorPlanes& t, int begin, int end) {
    const auto width = size_t(r.width());
    for (int y = begin; y < end && r.ignored; ++y) {
        const uint8_t* ignored = r.ignored->row(y);
        for (size_t x = 0, i = r.at(y); x < width; ++x, ++i) {
            if (ignored[x] == 0)
                continue;
            for (size_t p = 0; p < 3; ++p)
                t.plane[p][i] = r.plane[p][i];
            if (!t.alpha.empty())
                t.alpha[i] = r.alpha[i];
        }
    }
}

void fill_nonfinite(ColorPlanes& planes, float value) {
    for (size_t i = 0; planes.counts.nonfinite > 0 && i < planes.nonfinite.size(); ++i)
        for (size_t p = 0; planes.nonfinite[i] && p < 3; ++p)
            planes.plane[p][i] = value;
}

} // namespace tonetool
