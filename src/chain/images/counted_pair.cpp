// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/counted_pair.h"

#include <algorithm>
#include <cmath>

#include "imagebuf/pixels/float_rows.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

void check_alike(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b) {
    const bool flat = !a.deep() && !b.deep() && a.spec().depth == 1 && b.spec().depth == 1;
    if (!flat || a.roi() != b.roi()) {
        throw CommandError("mask= and ignore= are of flat images with the same data windows and "
                           "channels (valid: without them, or --cut of both images)");
    }
}

} // namespace

CountedPair::CountedPair(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b,
                         const IgnoreOptions& options, LeaveOut how)
    : m_region(a.roi()),
      m_how(how) {
    check_alike(a, b);
    std::string why;
    if (!ToneAlgo::ignored_pixels(m_marks, a.spec(), options, m_region, m_warnings, why))
        throw CommandError(why);
    m_counted = std::count(m_marks.begin(), m_marks.end(), 0);
    m_ignored = 1 - double(m_counted) / double(m_marks.size());
    for (size_t i = 0; i < 2; ++i) {
        const OIIO::ImageBuf& image = i == 0 ? a : b;
        if (how == LeaveOut::Closing)
            close(image, m_images[i]);
        else
            m_images[i] = image.copy(OIIO::TypeFloat);
    }
    if (how == LeaveOut::Equalizing)
        equalize();
}

void CountedPair::close(const OIIO::ImageBuf& from, OIIO::ImageBuf& to) const {
    OIIO::ImageSpec spec(int(m_counted), 1, from.nchannels(), OIIO::TypeFloat);
    spec.channelnames = from.spec().channelnames;
    to = OIIO::ImageBuf(spec, OIIO::InitializePixels::No);
    auto* out = static_cast<float*>(to.localpixels());
    const auto channels = size_t(from.nchannels()), width = size_t(m_region.width());
    for_each_row(from, from.roi(), [&](int y, const float* values) {
        const uint8_t* marks = m_marks.data() + size_t(y - m_region.ybegin) * width;
        for (size_t x = 0; x < width; ++x)
            if (marks[x] == 0)
                out = std::copy_n(values + x * channels, channels, out);
    });
}

void CountedPair::equalize() {
    OIIO::ImageBuf::Iterator<float> b(m_images[1]);
    const uint8_t* mark = m_marks.data();
    for (OIIO::ImageBuf::Iterator<float> a(m_images[0]); !a.done(); ++a, ++b, ++mark) {
        for (int c = 0; *mark != 0 && c < m_images[0].nchannels(); ++c) {
            const float value = a[c];
            const float kept = std::isfinite(value) ? value : 0.0F;
            a[c] = kept;
            b[c] = kept;
        }
    }
}

void CountedPair::place(int& x, int& y) const {
    if (m_how == LeaveOut::Equalizing)
        return;
    size_t at = 0;
    for (int left = x; at < m_marks.size(); ++at)
        if (m_marks[at] == 0 && left-- == 0)
            break;
    const auto width = size_t(m_region.width());
    x = m_region.xbegin + int(at % width);
    y = m_region.ybegin + int(at / width);
}

} // namespace tonetool::chain
