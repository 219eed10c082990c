// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/compare/ignored_alpha.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "imagebuf/compare/pair.h"
#include "imagebuf/pixels/row_source.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// The alpha of an image, some rows at a time.
class AlphaRows {
public:
    void open(const ImageBuf& image, int channel) {
        m_channel = channel;
        if (channel < 0)
            return;
        const OIIO::ImageSpec& native = image.nativespec();
        m_type = native.nchannels == image.nchannels() ? native.channelformat(channel)
                                                       : image.spec().channelformat(channel);
        m_source.open(image, runs_of({channel}));
    }

    // Half a step of the type; half float's, which is the coarsest beside integers, for others.
    double rounding() const {
        constexpr double byte = 0.5 / 255, half = 1.0 / 4096;
        return m_channel < 0 ? 0 : m_type == OIIO::TypeUInt8 ? byte + half : half;
    }

    void read(int begin, int end, const ROI& window) {
        const auto width = size_t(window.width()), rows = size_t(end - begin);
        m_values.assign(width * rows, 1.0f);
        if (m_channel < 0)
            return;
        const auto whole = size_t(m_source.width());
        m_rows.resize(whole * rows);
        m_source.read(begin, end, 0, m_rows.data());
        for (size_t y = 0; y < rows; ++y)
            std::copy_n(m_rows.begin() + ptrdiff_t(y * whole) + (window.xbegin - m_source.left()),
                        width, m_values.begin() + ptrdiff_t(y * width));
    }
    const std::vector<float>& values() const { return m_values; }

private:
    int m_channel = -1;
    OIIO::TypeDesc m_type;
    RowSource m_source;
    std::vector<float> m_rows, m_values;
};

} // namespace

int64_t count_alpha_differences(const ImageBuf& reference, const ColorChoice& of_reference,
                                const ImageBuf& test, const ColorChoice& of_test, const ROI& region,
                                const IgnoredPixels* ignored) {
    AlphaRows r, t;
    ROI both = OIIO::roi_intersection(plane_of(reference.roi()), plane_of(test.roi()));
    both = OIIO::roi_intersection(both, region);
    int64_t count = 0;
    r.open(reference, of_reference.a);
    t.open(test, of_test.a);
    const double rounding = r.rounding() + t.rounding();
    constexpr int step = 64;
    for (int y = both.ybegin; y < both.yend && both.width() > 0; y += step) {
        const int end = std::min(y + step, both.yend);
        r.read(y, end, both);
        t.read(y, end, both);
        for (size_t i = 0; i < r.values().size(); ++i) {
            const auto width = size_t(both.width());
            if (ignored && ignored->at(both.xbegin + int(i % width), y + int(i / width)))
                continue;
            count += !(std::abs(double(r.values()[i]) - double(t.values()[i])) <= rounding) &&
                     r.values()[i] != t.values()[i];
        }
    }
    return count;
}

} // namespace tonetool
