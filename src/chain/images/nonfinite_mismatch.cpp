#include "chain/images/nonfinite_mismatch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "text/error.h"

namespace tonetool::chain {

namespace {

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

} // namespace tonetool::chain
