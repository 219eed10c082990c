// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/gbuffer.h"

#include <algorithm>

#include "imagebuf/aov/gbuffer_check.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/planes.h"
#include "imagebuf/pixels/row_source.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

struct Plane {
    std::vector<float>* to;
    int channel;
};

class Reader {
public:
    Reader(const ImageBuf& image, const ImageBuf& image_of_all, ROI region, int nthreads,
           GBuffer& out)
        : m_image(image),
          m_image_of_all(&image_of_all),
          m_region(region),
          m_parallel(make_parallel(nthreads)),
          m_out(out) {}

    /// Takes the guide if it lies in this image.
    void want(const char* guide, const std::optional<GuideChannels>& from,
              std::vector<float>* planes, int count);
    /// Pixels that it does not cover remain or, if others were read before, become background.
    void read();

private:
    bool fits(const char* guide, const GuideChannels& from, int count);
    void cover(const ROI& window);
    void copy_row(int y, int first, const ROI& window, const std::vector<std::vector<float>>& rows);

    const ImageBuf& m_image;
    const ImageBuf* m_image_of_all; ///< that has what is in no file of its own
    ROI m_region;
    kernels::ParallelFor m_parallel;
    GBuffer& m_out;
    std::vector<Plane> m_planes;
    RowSource m_source;
};

// Integers are made 0..1 on reading: colours and encoded normals survive that, distances do not.
bool Reader::fits(const char* guide, const GuideChannels& from, int count) {
    const OIIO::ImageSpec& native = m_image.nativespec();
    const bool known = native.nchannels == m_image.nchannels();
    for (int c = 0; c < count; ++c) {
        const OIIO::TypeDesc type = known ? native.channelformat(from.channel[c]) : OIIO::TypeFloat;
        const bool measures = guide == std::string("position") || guide == std::string("depth");
        if (type.is_floating_point() || (!measures && type.size() <= 2))
            continue;
        m_out.warnings.push_back(std::string(guide) + " layer \"" + from.layer +
                                 "\" is not used: it is stored as " + type.c_str());
        return false;
    }
    return true;
}

void Reader::want(const char* guide, const std::optional<GuideChannels>& from,
                  std::vector<float>* planes, int count) {
    const ImageBuf* const image = from && from->file ? from->file.get() : m_image_of_all;
    if (!from || image != &m_image || !fits(guide, *from, count))
        return;
    for (int c = 0; c < count; ++c) {
        planes[c].assign(m_out.background.size(), 0.0f);
        m_planes.push_back({&planes[c], from->channel[c]});
    }
}

void Reader::cover(const ROI& window) {
    const bool first = &m_image == m_image_of_all;
    for (int y = m_region.ybegin; y < m_region.yend; ++y) {
        uint8_t* const row =
            m_out.background.data() + size_t(y - m_region.ybegin) * size_t(m_out.width);
        const bool inside = y >= window.ybegin && y < window.yend;
        for (int x = m_region.xbegin; x < m_region.xend; ++x) {
            const bool covered = inside && x >= window.xbegin && x < window.xend;
            uint8_t& none = row[x - m_region.xbegin];
            none = covered ? (first ? 0 : none) : 1;
        }
    }
}

void Reader::copy_row(int y, int first, const ROI& window,
                      const std::vector<std::vector<float>>& rows) {
    for (const Plane& plane : m_planes)
        for (size_t r = 0; r < rows.size(); ++r) {
            const ChannelRun& run = m_source.runs()[r];
            if (plane.channel < run.begin || plane.channel >= run.end)
                continue;
            const auto stride = size_t(run.count());
            const float* from = rows[r].data() + size_t(plane.channel - run.begin) +
                                (size_t(y - first) * size_t(m_source.width()) +
                                 size_t(window.xbegin - m_source.left())) *
                                    stride;
            float* to = plane.to->data() + size_t(y - m_region.ybegin) * size_t(m_out.width) +
                        size_t(window.xbegin - m_region.xbegin);
            for (int x = window.xbegin; x < window.xend; ++x, from += stride)
                *to++ = *from;
        }
}

void Reader::read() {
    const ROI window = OIIO::roi_intersection(m_image.roi(), m_region);
    cover(window);
    if (m_planes.empty() || window.width() <= 0 || window.height() <= 0)
        return;
    std::vector<int> channels;
    for (const Plane& plane : m_planes)
        channels.push_back(plane.channel);
    m_source.open(m_image, runs_of(channels));
    std::vector<std::vector<float>> rows(m_source.runs().size());
    for (int first = window.ybegin; first < window.yend;) {
        const int last = std::min(first + m_source.rows_at_once(first), window.yend);
        for (size_t r = 0; r < rows.size(); ++r) {
            rows[r].resize(size_t(last - first) * size_t(m_source.width()) *
                           size_t(m_source.runs()[r].count()));
            m_source.read(first, last, r, rows[r].data());
        }
        m_parallel(last - first,
                   [&](int64_t row) { copy_row(first + int(row), first, window, rows); });
        first = last;
    }
}

} // namespace

GBuffer read_gbuffer(const ImageBuf& image, const GBufferNames& names, ROI region, int nthreads) {
    GBuffer out;
    check_readable(image, "guide");
    if (region.width() <= 0 || region.height() <= 0)
        throw Refusal("the region holds no pixel");
    out.width = region.width();
    out.height = region.height();
    out.background.assign(size_t(out.width) * size_t(out.height), 1);
    // Each image once, the one itself first.
    std::vector<const ImageBuf*> images{&image};
    for (const auto* guide : {&names.position, &names.normal, &names.albedo, &names.depth})
        if (*guide && (*guide)->file &&
            std::find(images.begin(), images.end(), (*guide)->file.get()) == images.end())
            images.push_back((*guide)->file.get());
    for (const ImageBuf* from : images) {
        Reader reader(*from, image, region, nthreads, out);
        reader.want("position", names.position, out.position, 3);
        reader.want("normal", names.normal, out.normal, 3);
        reader.want("albedo", names.albedo, out.albedo, 3);
        reader.want("depth", names.depth, &out.depth, 1);
        of_side(side_name("guide", *from), [&] { reader.read(); });
    }
    check_gbuffer(out, names, make_parallel(nthreads));
    return out;
}

} // namespace tonetool
