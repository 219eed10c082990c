#include "imagebuf/planes.h"

#include <algorithm>
#include <atomic>
#include <cfloat>
#include <cmath>
#include <cstring>

#include "imagebuf/colorimetry.h"
#include "imagebuf/parallel.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// Rows per task: enough to be worth a task, few enough to stay small beside the image.
constexpr int kBand = 64;

// `count` channels from `first` of the pixels of `roi`, interleaved.
bool get_channels(const ImageBuf& image, ROI roi, int first, int count, float* out) {
    roi.chbegin = first;
    roi.chend = first + count;
    return image.get_pixels(roi, OIIO::TypeFloat, out);
}

struct Counts {
    int64_t nonfinite = 0, negative = 0;
    uint64_t negative_digest = 0;
};

// A hash of a pixel and its place; sums of these do not depend on the order.
uint64_t digest(size_t place, const double (&v)[3]) {
    uint64_t h = place + 0x9e3779b97f4a7c15u;
    for (double x : v) {
        uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof bits);
        h = (h ^ bits) * 0xbf58476d1ce4e5b9u;
        h ^= h >> 31;
    }
    return h;
}

class Reader {
public:
    Reader(const ImageBuf& image, const ColorSpace& space, ColorPlanes& out)
        : m_image(image),
          m_space(space),
          m_out(out) {}

    bool read(int nthreads) {
        const int bands = (m_out.height() + kBand - 1) / kBand;
        make_parallel(nthreads)(bands, [this](int64_t band) { read_band(int(band) * kBand); });
        m_out.nonfinite_count = m_nonfinite;
        m_out.negative_count = m_negative;
        m_out.negative_digest = m_negative_digest;
        for (const auto& p : m_out.plane)
            if (!p.empty())
                m_out.largest = std::max(m_out.largest, *std::max_element(p.begin(), p.end()));
        return !m_failed;
    }

private:
    void read_band(int from) {
        ROI roi = m_out.region;
        roi.ybegin = m_out.region.ybegin + from;
        roi.yend = std::min(roi.ybegin + kBand, m_out.region.yend);
        const size_t at = size_t(from) * size_t(m_out.width());
        const size_t n = size_t(roi.width()) * size_t(roi.height());
        if (!read_color(roi, at, n) || !read_alpha(roi, at)) {
            m_failed = true;
            return;
        }
        Counts counts;
        for (size_t i = at; i < at + n; ++i)
            clean(i, counts);
        m_nonfinite += counts.nonfinite;
        m_negative += counts.negative;
        m_negative_digest += counts.negative_digest;
    }

    bool read_color(const ROI& roi, size_t at, size_t n) {
        const ColorChoice& c = m_out.choice;
        const int channel[3] = {c.r, c.g, c.b};
        if (c.g == c.r + 1 && c.b == c.r + 2) {
            std::vector<float> pixels(n * 3);
            if (!get_channels(m_image, roi, c.r, 3, pixels.data()))
                return false;
            for (size_t i = 0; i < n; ++i)
                for (size_t p = 0; p < 3; ++p)
                    m_out.plane[p][at + i] = pixels[i * 3 + p];
            return true;
        }
        for (int p = 0; p < 3; ++p)
            if (!get_channels(m_image, roi, channel[p], 1, m_out.plane[p].data() + at))
                return false;
        return true;
    }

    bool read_alpha(const ROI& roi, size_t at) {
        if (m_out.alpha.empty())
            return true;
        if (m_out.choice.a >= 0)
            return get_channels(m_image, roi, m_out.choice.a, 1, m_out.alpha.data() + at);
        const ROI covered = OIIO::roi_intersection(roi, m_image.roi());
        for (int y = covered.ybegin; y < covered.yend; ++y) {
            float* row = m_out.alpha.data() + at + size_t(y - roi.ybegin) * size_t(roi.width());
            std::fill(row + (covered.xbegin - roi.xbegin), row + (covered.xend - roi.xbegin), 1.0f);
        }
        return true;
    }

    // One pixel to finite linear Rec.709 >= 0.
    void clean(size_t i, Counts& counts) {
        double v[3] = {m_out.plane[0][i], m_out.plane[1][i], m_out.plane[2][i]};
        bool finite = std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
        if (!m_out.alpha.empty() && !std::isfinite(m_out.alpha[i])) {
            finite = false;
            m_out.alpha[i] = 0;
        }
        if (finite)
            to_rec709(v);
        const bool below = finite && (v[0] < 0 || v[1] < 0 || v[2] < 0);
        for (size_t p = 0; p < 3; ++p)
            m_out.plane[p][i] = finite ? float(std::clamp(v[p], 0.0, double(FLT_MAX))) : 0.0f;
        m_out.nonfinite[i] = !finite;
        counts.nonfinite += !finite;
        counts.negative += below;
        if (below)
            counts.negative_digest += digest(i, v);
    }

    void to_rec709(double (&v)[3]) const {
        if (m_space.srgb_encoded)
            for (double& x : v)
                x = srgb_to_linear(x);
        if (m_space.is_rec709)
            return;
        const double in[3] = {v[0], v[1], v[2]};
        for (size_t p = 0; p < 3; ++p) {
            const auto& row = m_space.to_rec709[p];
            v[p] = row[0] * in[0] + row[1] * in[1] + row[2] * in[2];
        }
    }

    const ImageBuf& m_image;
    const ColorSpace& m_space;
    ColorPlanes& m_out;
    std::atomic<int64_t> m_nonfinite{0}, m_negative{0};
    std::atomic<uint64_t> m_negative_digest{0};
    std::atomic<bool> m_failed{false};
};

} // namespace

kernels::ConstRgb ColorPlanes::view() const {
    return {{plane[0].data(), plane[1].data(), plane[2].data()}, width(), width(), height()};
}

std::string side_name(const char* side, const ImageBuf& image) {
    const std::string name(image.name());
    return std::string(side) + " image" + (name.empty() ? ": " : " \"" + name + "\": ");
}

bool check_readable(const ImageBuf& image, const char* what, std::string& error) {
    const auto fail = [&](const std::string& why) {
        error = side_name(what, image) + why;
        return false;
    };
    if (!image.initialized() && !image.has_error() && image.name().empty())
        return fail("is not initialized");
    if (image.spec().nchannels == 0 || image.has_error()) {
        const std::string why = image.geterror();
        return fail(why.empty() ? "could not be read" : why);
    }
    if (image.deep())
        return fail("deep images are not supported; flatten it first");
    if (image.spec().depth > 1)
        return fail("volumes are not supported");
    if (image.roi().width() <= 0 || image.roi().height() <= 0)
        return fail("has no pixels");
    return true;
}

OIIO::ImageSpec deciding_spec(const ImageBuf& image) {
    OIIO::ImageSpec spec = image.spec();
    const OIIO::ImageSpec& native = image.nativespec();
    if (native.nchannels != spec.nchannels)
        return spec;
    if (!native.format.is_floating_point())
        spec.format = native.format;
    spec.channelformats = native.channelformats;
    return spec;
}

bool read_planes(const ImageBuf& image, const PixelOptions& options, ROI region, bool want_alpha,
                 int nthreads, ColorPlanes& out, std::string& error) {
    const OIIO::ImageSpec spec = deciding_spec(image);
    ColorSpace space;
    if (!ToneAlgo::find_color(spec, options, out.choice, error) ||
        !find_space(spec, options.from, space, error))
        return false;
    out.region = region;
    const size_t n = size_t(region.width()) * size_t(region.height());
    for (auto& p : out.plane)
        p.assign(n, 0.0f);
    out.nonfinite.assign(n, 0);
    out.alpha.assign(want_alpha ? n : 0, 0.0f);
    const ROI covered = OIIO::roi_intersection(region, image.roi());
    const int64_t inside = covered.width() > 0 && covered.height() > 0
                               ? int64_t(covered.width()) * covered.height()
                               : 0;
    out.uncovered_count = int64_t(n) - inside;
    if (Reader(image, space, out).read(nthreads) && !image.has_error())
        return true;
    error = image.geterror();
    if (error.empty())
        error = "pixels could not be read";
    return false;
}

} // namespace tonetool
