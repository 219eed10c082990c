// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/unseen_difference.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "imagebuf/pixels/upright.h"
#include "text/error.h"
#include "text/text.h"

namespace tonetool::chain {

namespace {

using OIIO::Strutil::fmt::format;

constexpr int64_t kValuesAtOnce = int64_t(1) << 21; // of one image

bool mismatch(float a, float b) {
    return std::isnan(a) != std::isnan(b) || ((std::isinf(a) || std::isinf(b)) && a != b);
}

bool has_numbers_only(const OIIO::ImageBuf& image) {
    const auto& types = image.spec().channelformats;
    return !image.spec().format.is_floating_point() &&
           std::none_of(types.begin(), types.end(),
                        [](const OIIO::TypeDesc& type) { return type.is_floating_point(); });
}

// The values of some rows of one image.
class Rows {
public:
    Rows(const OIIO::ImageBuf& image, OIIO::ROI rows)
        : m_channels(image.nchannels()),
          m_values(size_t(rows.npixels()) * size_t(m_channels)) {
        rows.chbegin = 0;
        rows.chend = m_channels;
        if (!image.get_pixels(rows, OIIO::TypeFloat, m_values.data()))
            throw CommandError(image.geterror());
    }

    bool finite() const {
        return std::all_of(m_values.begin(), m_values.end(),
                           [](float value) { return std::isfinite(value); });
    }
    float at(size_t pixel, int channel) const {
        return channel < m_channels ? m_values[pixel * size_t(m_channels) + size_t(channel)] : 0;
    }

private:
    int m_channels;
    std::vector<float> m_values;
};

void note(NonfiniteMismatch& found, int x, int y, int z, int channel) {
    if (found.pixels++ == 0) {
        found.x = x;
        found.y = y;
        found.z = z;
        found.channel = channel;
    }
}

void look_at_rows(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b, const OIIO::ROI& rows,
                  NonfiniteMismatch& found) {
    const Rows of_a(a, rows), of_b(b, rows);
    if (of_a.finite() && of_b.finite())
        return;
    const int channels = std::max(a.nchannels(), b.nchannels());
    for (size_t i = 0; i < rows.npixels(); ++i) {
        for (int c = 0; c < channels; ++c) {
            if (mismatch(of_a.at(i, c), of_b.at(i, c))) {
                const int width = rows.width();
                note(found, rows.xbegin + int(i) % width, rows.ybegin + int(i) / width, rows.zbegin,
                     c);
                break;
            }
        }
    }
}

// The first channel with mismatched samples; -1 if there is none.
int mismatched_channel(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b, int x, int y, int z) {
    const int of_a = a.deep_samples(x, y, z), of_b = b.deep_samples(x, y, z);
    const int channels = std::max(a.nchannels(), b.nchannels());
    for (int c = 0; c < channels; ++c) {
        for (int s = 0; s < std::max(of_a, of_b); ++s) {
            const float value_a = s < of_a && c < a.nchannels() ? a.deep_value(x, y, z, c, s) : 0;
            const float value_b = s < of_b && c < b.nchannels() ? b.deep_value(x, y, z, c, s) : 0;
            if (mismatch(value_a, value_b))
                return c;
        }
    }
    return -1;
}

void look_at_samples(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b, const OIIO::ROI& rows,
                     NonfiniteMismatch& found) {
    for (int y = rows.ybegin; y < rows.yend; ++y) {
        for (int x = rows.xbegin; x < rows.xend; ++x) {
            const int channel = mismatched_channel(a, b, x, y, rows.zbegin);
            if (channel >= 0)
                note(found, x, y, rows.zbegin, channel);
        }
    }
}

std::string window_text(const OIIO::ROI& window) {
    return format("{}x{}{:+}{:+}", window.width(), window.height(), window.xbegin, window.ybegin);
}

// Of one of several parts: that of a file's only one is not what its picture is known by.
std::string name_of_part(const OIIO::ImageSpec& spec) {
    const std::string view = spec.get_string_attribute("view");
    return spec.get_int_attribute("oiio:subimages") < 2
               ? ""
               : std::string(spec.get_string_attribute("oiio:subimagename")) +
                     (view.empty() ? "" : " of view " + view);
}

} // namespace

NonfiniteMismatch find_nonfinite_mismatch(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b) {
    NonfiniteMismatch found;
    const bool deep = a.deep() && b.deep();
    if ((has_numbers_only(a) && has_numbers_only(b)) || (a.deep() != b.deep()))
        return found;
    const OIIO::ROI all = OIIO::roi_union(a.roi(), b.roi());
    const int64_t in_row = int64_t(all.width()) * std::max(a.nchannels(), b.nchannels());
    const int step = int(std::clamp<int64_t>(kValuesAtOnce / std::max<int64_t>(in_row, 1), 1,
                                             std::max(all.height(), 1)));
    for (int z = all.zbegin; z < all.zend; ++z) {
        for (int y = all.ybegin; y < all.yend; y += step) {
            OIIO::ROI rows = all;
            rows.zbegin = z;
            rows.zend = z + 1;
            rows.ybegin = y;
            rows.yend = std::min(y + step, all.yend);
            (deep ? look_at_samples : look_at_rows)(a, b, rows, found);
        }
    }
    return found;
}

OIIO::imagesize_t unseen_differences(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b,
                                     float limit) {
    constexpr int looked_at = 3;
    const OIIO::ROI all = a.roi();
    const size_t channels = size_t(a.nchannels());
    std::vector<float> values_of_a(size_t(all.width()) * channels), values_of_b(values_of_a.size());
    OIIO::imagesize_t pixels = 0;
    for (int y = all.ybegin; y < all.yend; ++y) {
        OIIO::ROI row = all;
        row.ybegin = y;
        row.yend = y + 1;
        a.get_pixels(row, OIIO::TypeFloat, values_of_a.data());
        b.get_pixels(row, OIIO::TypeFloat, values_of_b.data());
        for (size_t at = 0; at < values_of_a.size(); at += channels) {
            const float *one = &values_of_a[at], *other = &values_of_b[at];
            const auto finite = [](float value) { return std::isfinite(value); };
            const size_t colors = std::min<size_t>(channels, looked_at);
            const bool seen = std::all_of(one, one + colors, finite) &&
                              std::all_of(other, other + colors, finite);
            bool differs = false;
            for (size_t c = seen ? colors : 0; c < channels; ++c)
                differs = differs || std::abs(one[c] - other[c]) > limit;
            pixels += differs ? 1 : 0;
        }
    }
    return pixels;
}

std::string difference_of_headers(const OIIO::ImageSpec& a, const OIIO::ImageSpec& b) {
    const auto windows = [](const OIIO::ROI& r, const OIIO::ROI& t) {
        return window_text(r) + " vs " + window_text(t);
    };
    const auto same = [](const OIIO::ROI& r, const OIIO::ROI& t) {
        return r.xbegin == t.xbegin && r.xend == t.xend && r.ybegin == t.ybegin &&
               r.yend == t.yend && r.zbegin == t.zbegin && r.zend == t.zend;
    };
    if (!same(a.roi(), b.roi()))
        return "Images differ in size (data windows " + windows(a.roi(), b.roi()) + ")";
    if (!same(a.roi_full(), b.roi_full())) {
        return "Images differ in their display windows (" + windows(a.roi_full(), b.roi_full()) +
               ")";
    }
    if (a.channelnames != b.channelnames) {
        return "Images differ in their channels (" + join(a.channelnames, ",") + " vs " +
               join(b.channelnames, ",") + ")";
    }
    if (name_of_part(a) != name_of_part(b)) {
        return "Images differ in the names of their parts (" + name_of_part(a) + " vs " +
               name_of_part(b) + ")";
    }
    if (orientation_of(a) != orientation_of(b)) {
        return format("Images differ in Orientation ({} vs {})", orientation_of(a),
                      orientation_of(b));
    }
    return "";
}

} // namespace tonetool::chain
