// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/ignored_pixels.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <regex>

#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/planes.h"
#include "imagebuf/pixels/row_source.h"
#include "imagebuf/pixels/upright.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

constexpr float kCounts = 0.5f; // the least value of a mask where a pixel counts

// "64x32+10-5": digits, and a sign before each offset.
ROI parsed_region(const std::string& text) {
    static const std::regex form("([0-9]{1,9})x([0-9]{1,9})([+-][0-9]{1,9})([+-][0-9]{1,9})");
    std::smatch found;
    int numbers[4] = {};
    const bool fits = std::regex_match(text, found, form);
    for (size_t i = 0; fits && i < 4; ++i)
        numbers[i] = std::stoi(found[i + 1]);
    const auto [width, height, x, y] = numbers;
    if (width < 1 || height < 1)
        throw Refusal(
            format("ignore has \"{}\": must be WxH+X+Y, with commas between several", text));
    return {x, x + width, y, y + height, 0, 1, 0, 1};
}

void check_mask(const ImageSpec& mask, const ImageSpec& reference) {
    if (mask.full_width != reference.full_width || mask.full_height != reference.full_height)
        throw Refusal(format("it has {}x{} pixels, the reference {}x{} (of the display windows): "
                             "they must be the same",
                             mask.full_width, mask.full_height, reference.full_width,
                             reference.full_height));
    const int m = orientation_of(mask), r = orientation_of(reference);
    if (m != r)
        throw Refusal(format("its Orientation is {}, that of the reference {}: they must be turned "
                             "alike",
                             m, r));
}

} // namespace

void IgnoredPixels::open(const IgnoreOptions& options, const ImageSpec& reference,
                         const ROI& region) {
    m_region = region;
    m_asked = options.any();
    m_ignored.clear();
    if (!m_asked)
        return;
    const uint64_t bytes = uint64_t(region.width()) * uint64_t(region.height());
    expect_memory(bytes);
    m_ignored.assign(size_t(bytes), 0);
    if (options.mask.given())
        mark_mask(options.mask, reference);
    for (const std::string& text : options.ignore)
        mark_region(text);
    if (std::find(m_ignored.begin(), m_ignored.end(), 1) == m_ignored.end())
        m_ignored = {};
    (void)counted(region);
}

void IgnoredPixels::mark_mask(const Mask& mask, const ImageSpec& reference) {
    const auto run = [&](const ImageBuf& image) {
        check_readable(image, "mask");
        const std::string name(image.name());
        refusing_as(
            [&](const std::string& why) {
                return with_side(name.empty() ? "mask: " : "mask \"" + name + "\": ", why);
            },
            [&] {
                check_mask(image.spec(), reference);
                mark_by(image, reference);
            });
    };
    if (mask.image)
        return run(*mask.image);
    if (!OIIO::Filesystem::exists(mask.file))
        throw Refusal("mask \"" + mask.file + "\": there is no such file");
    run(ImageBuf(mask.file));
}

// Where the mask has no pixel it is 0; beyond its display window it says nothing.
void IgnoredPixels::mark_by(const ImageBuf& mask, const ImageSpec& reference) {
    const ImageSpec& spec = mask.spec();
    const int to_x = reference.full_x - spec.full_x, to_y = reference.full_y - spec.full_y;
    const ROI full = reference.roi_full();
    for (int y = std::max(m_region.ybegin, full.ybegin); y < std::min(m_region.yend, full.yend);
         ++y)
        for (int x = std::max(m_region.xbegin, full.xbegin); x < std::min(m_region.xend, full.xend);
             ++x)
            writable(y)[x - m_region.xbegin] = 1;
    RowSource source;
    source.open(mask, {{0, 1}});
    const int left = spec.x + to_x, first = std::max(m_region.ybegin, spec.y + to_y);
    const int from = std::max(m_region.xbegin, left),
              to = std::min(m_region.xend, left + spec.width);
    const int last = std::min(m_region.yend, spec.y + to_y + spec.height);
    std::vector<float> rows;
    for (int begin = first; begin < last && from < to;) {
        const int end = std::min(last, begin + source.rows_at_once(begin - to_y));
        rows.resize(size_t(end - begin) * size_t(spec.width));
        source.read(begin - to_y, end - to_y, 0, rows.data());
        for (int y = begin; y < end; ++y) {
            const float* values = rows.data() + size_t(y - begin) * size_t(spec.width);
            for (int x = from; x < to; ++x)
                writable(y)[x - m_region.xbegin] = uint8_t(!(values[x - left] >= kCounts));
        }
        begin = end;
    }
}

void IgnoredPixels::mark_region(const std::string& text) {
    ROI part = parsed_region(text);
    part = OIIO::roi_intersection(part, m_region);
    if (part.width() <= 0 || part.height() <= 0)
        throw Refusal(format("ignore has \"{}\", which holds none of the compared pixels, "
                             "{}x{}{:+}{:+}",
                             text, m_region.width(), m_region.height(), m_region.xbegin,
                             m_region.ybegin));
    for (int y = part.ybegin; y < part.yend; ++y)
        std::fill_n(writable(y) + (part.xbegin - m_region.xbegin), part.width(), uint8_t(1));
}

int64_t IgnoredPixels::count(const ROI& part) const {
    int64_t ignored = 0;
    for (int y = part.ybegin; y < part.yend && any(); ++y) {
        const uint8_t* first = row(y) + (part.xbegin - m_region.xbegin);
        ignored += std::count(first, first + part.width(), 1);
    }
    return ignored;
}

int64_t IgnoredPixels::counted(const ROI& part) const {
    const int64_t count = int64_t(part.width()) * part.height() - this->count(part);
    if (count == 0)
        throw Refusal("mask and ignore leave no pixel that counts: there is nothing to compare (a "
                      "mask counts where it is "
                      "0.5 or more, as uint8 from 128 on)");
    return count;
}

std::optional<double> IgnoredPixels::share(const ROI& part) const {
    if (!m_asked)
        return std::nullopt;
    const double pixels = double(part.width()) * part.height();
    return (pixels - double(counted(part))) / pixels;
}

void warn_of_ignored(const std::optional<double>& share, std::vector<std::string>& warnings) {
    constexpr double half = 0.5;
    if (share.value_or(0) > half)
        warnings.push_back(format("{:.3g} % of the pixels do not count: mask and ignore leave "
                                  "less than half of the picture",
                                  100 * *share));
}

Mask mask_of(const IgnoredPixels& ignored, const ROI& region) {
    if (!ignored.any())
        return {};
    ImageSpec spec(region.width(), region.height(), 1, OIIO::TypeUInt8);
    spec.x = spec.full_x = region.xbegin;
    spec.y = spec.full_y = region.ybegin;
    auto image = std::make_shared<ImageBuf>(allocated_image(spec));
    auto* pixels = static_cast<uint8_t*>(image->localpixels());
    std::transform(ignored.all().begin(), ignored.all().end(), pixels,
                   [](uint8_t one) { return uint8_t(one != 0 ? 0 : UINT8_MAX); });
    return {"", std::move(image)};
}

bool ToneAlgo::ignored_pixels(std::vector<uint8_t>& ignored, const ImageSpec& reference,
                              const IgnoreOptions& options, ROI region,
                              std::vector<std::string>& warnings, std::string& error) {
    return contained(error, [&] {
        IgnoredPixels found;
        found.open(options, reference, region);
        warn_of_ignored(found.share(region), warnings);
        ignored = found.all();
        if (ignored.empty())
            ignored.assign(size_t(region.width()) * size_t(region.height()), 0);
    });
}

} // namespace tonetool
