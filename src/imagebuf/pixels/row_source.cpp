// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/row_source.h"

#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <utility>

#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/cut_file.h"
#include "imagebuf/pixels/has_pixels.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "imagebuf/pixels/rows_together.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;

// Channels as far apart as this are still read at once.
constexpr int kGap = 2;

// What OpenEXR compresses together; chunks of whole blocks are not decoded twice.
int rows_per_block(const std::string& compression) {
    const std::pair<const char*, int> known[] = {{"zips", 1},  {"none", 1},  {"rle", 1},
                                                 {"piz", 32},  {"b44", 32},  {"b44a", 32},
                                                 {"dwaa", 32}, {"dwab", 256}};
    const std::string name = compression.substr(0, compression.find(':'));
    for (const auto& [other, rows] : known)
        if (name == other)
            return rows;
    return 16;
}

bool same_pixels(const ImageSpec& a, const ImageSpec& b) {
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height &&
           a.channelnames == b.channelnames && a.deep == b.deep;
}

} // namespace

std::vector<ChannelRun> runs_of(std::vector<int> channels) {
    std::sort(channels.begin(), channels.end());
    std::vector<ChannelRun> runs;
    for (int channel : channels)
        if (runs.empty() || channel > runs.back().end + kGap)
            runs.push_back({channel, channel + 1});
        else
            runs.back().end = std::max(runs.back().end, channel + 1);
    return runs;
}

void RowSource::open(const ImageBuf& image, std::vector<ChannelRun> runs) {
    m_image = &image;
    m_runs = std::move(runs);
    m_spec = image.spec();
    m_from_file = is_file_to_read(image);
    if (!m_from_file)
        return;
    m_state = state();
    m_blocks.resize(m_runs.size());
    refusing_as([&](const std::string& why) { return named(why); }, [&] { open_file(); });
}

std::string RowSource::named(const std::string& error) const {
    return with_name(*m_image, error);
}

void RowSource::open_file() {
    const std::string name(m_image->name());
    m_input = oiio::open_input(name);
    if (!m_input)
        throw Refusal(OIIO::geterror());
    if (const std::string why = bytes_missing(*m_input, name); !why.empty())
        throw Refusal(why);
    m_spec = m_input->spec(m_image->subimage(), m_image->miplevel());
    m_format = m_input->format_name();
    if (!same_pixels(m_spec, m_image->spec()))
        throw Refusal("the file has changed since it was opened");
    m_block = rows_together(m_spec, m_format);
    check_unchanged();
}

RowSource::FileState RowSource::state() const {
    std::error_code ignored;
    const std::string name(m_image->name());
    return {std::filesystem::last_write_time(name, ignored),
            std::filesystem::file_size(name, ignored)};
}

void RowSource::check_unchanged() const {
    if (!(state() == m_state))
        throw Refusal("the file has changed since it was opened");
}

int RowSource::rows_at_once(int row, size_t bytes) const {
    int channels = 1;
    for (const ChannelRun& run : m_runs)
        channels += run.count();
    const size_t row_bytes = size_t(m_spec.width) * size_t(channels) * sizeof(float);
    const int wanted = int(std::clamp<size_t>(bytes / row_bytes, 1, 1 << 20));
    const int block = m_block > 0 ? m_block : 16;
    const int past = (std::max(row, m_spec.y) - m_spec.y) % block;
    return std::max(1, std::max(wanted / block, 1) * block - past);
}

size_t RowSource::decoder_bytes() const {
    if (!m_from_file)
        return 0;
    const auto width = size_t(m_spec.width);
    const size_t pixel = m_spec.pixel_bytes(true);
    if (m_block > 0)
        return width * size_t(m_block) * pixel;
    if (m_format != "openexr")
        return 0;
    // Per thread two blocks of rows, packed and unpacked, with all channels of the file.
    const int rows = rows_per_block(m_spec.get_string_attribute("compression"));
    return size_t(oiio::exr_threads()) * 4 * size_t(rows) * width * pixel;
}

size_t RowSource::kept_bytes() const {
    size_t bytes = 0;
    if (m_from_file)
        for (const ChannelRun& run : m_runs)
            bytes += size_t(m_spec.width) * size_t(m_block) * size_t(run.count()) * sizeof(float);
    return bytes;
}

void RowSource::read(int begin, int end, size_t run, float* out) {
    refusing_as(
        [&](const std::string& why) {
            return named(why.empty() ? "pixels could not be read" : why);
        },
        [&] { fetch(begin, end, run, out); });
}

void RowSource::fetch(int begin, int end, size_t run, float* out) {
    const ChannelRun& channels = m_runs[run];
    if (!m_from_file) {
        const OIIO::ROI all = m_image->roi();
        const OIIO::ROI rows(all.xbegin, all.xend, begin, end, 0, 1, channels.begin, channels.end);
        if (!m_image->get_pixels(rows, OIIO::TypeFloat, out) || m_image->has_error())
            throw Refusal(m_image->geterror());
        return;
    }
    if (!m_input)
        open_file();
    if (!read_file(begin, end, run, out) || m_input->has_error())
        throw Refusal(m_input->geterror());
    check_unchanged();
}

bool RowSource::read_file(int begin, int end, size_t run, float* out) {
    return m_block > 0 ? read_blocks(begin, end, run, out) : read_block(begin, end, run, out);
}

bool RowSource::read_blocks(int begin, int end, size_t run, float* out) {
    Block& block = m_blocks[run];
    const size_t row = size_t(m_spec.width) * size_t(m_runs[run].count());
    for (int y = begin; y < end;) {
        if (y < block.begin || y >= block.end) {
            const int first = y - (y - m_spec.y) % m_block;
            const int last = std::min(first + m_block, m_spec.y + m_spec.height);
            block.begin = block.end = first;
            block.pixels.resize(row * size_t(last - first));
            if (!read_block(first, last, run, block.pixels.data()))
                return false;
            block.end = last;
        }
        const int until = std::min(end, block.end);
        const float* from = block.pixels.data() + size_t(y - block.begin) * row;
        std::copy_n(from, row * size_t(until - y), out + size_t(y - begin) * row);
        y = until;
    }
    return true;
}

bool RowSource::read_block(int begin, int end, size_t run, float* out) {
    const ChannelRun& channels = m_runs[run];
    const int subimage = m_image->subimage(), level = m_image->miplevel();
    if (m_spec.tile_width > 0)
        return m_input->read_tiles(subimage, level, m_spec.x, m_spec.x + m_spec.width, begin, end,
                                   0, 1, channels.begin, channels.end, OIIO::TypeFloat, out);
    return m_input->read_scanlines(subimage, level, begin, end, 0, channels.begin, channels.end,
                                   OIIO::TypeFloat, out);
}

void RowSource::rest() {
    if (m_from_file && m_format == "openexr")
        m_input.reset();
}

namespace {

// The rows of a file into an image of float, which may be narrower.
void fill_from_file(RowSource& source, ImageBuf& out) {
    const OIIO::ROI part = out.roi();
    const auto channels = size_t(out.nchannels());
    const size_t from = size_t(part.xbegin - source.left()) * channels;
    const size_t whole = size_t(source.width()) * channels, row = size_t(part.width()) * channels;
    std::vector<float> rows;
    for (int y = part.ybegin; y < part.yend;) {
        const int end = std::min(y + source.rows_at_once(y), part.yend);
        auto* to = static_cast<float*>(out.pixeladdr(part.xbegin, y));
        rows.resize(whole > row ? whole * size_t(end - y) : 0);
        source.read(y, end, 0, rows.empty() ? to : rows.data());
        for (size_t i = 0; !rows.empty() && i < size_t(end - y); ++i)
            std::copy_n(rows.data() + i * whole + from, row, to + i * row);
        y = end;
    }
}

} // namespace

OIIO::ImageBuf copy_pixels(const OIIO::ImageBuf& image, const OIIO::ROI& part, int nthreads) {
    RowSource source;
    source.open(image, {{0, image.nchannels()}});
    OIIO::ImageSpec spec = image.spec();
    spec.set_format(OIIO::TypeFloat);
    spec.x = part.xbegin;
    spec.y = part.ybegin;
    spec.width = part.width();
    spec.height = part.height();
    if (source.from_file()) // nobody gave it tiles yet
        spec.tile_width = spec.tile_height = spec.tile_depth = 0;
    try {
        expect_memory(spec.image_bytes());
    } catch (const TooLarge& failure) {
        throw Refusal(with_name(image, failure.what()));
    }
    OIIO::ImageBuf pixels = allocated_image(spec);
    if (source.from_file())
        fill_from_file(source, pixels);
    else if (!OIIO::ImageBufAlgo::copy(pixels, image, OIIO::TypeFloat, pixels.roi(), nthreads) ||
             image.has_error())
        throw Refusal(with_name(image, image.has_error() ? image.geterror() : pixels.geterror()));
    return pixels;
}

bool same_window(const OIIO::ROI& a, const OIIO::ROI& b) {
    return a.xbegin == b.xbegin && a.xend == b.xend && a.ybegin == b.ybegin && a.yend == b.yend;
}

OIIO::ROI part_of(const OIIO::ImageBuf& image, const OIIO::ROI& roi) {
    OIIO::ROI part = roi.defined() ? OIIO::roi_intersection(roi, image.roi()) : image.roi();
    part.chbegin = 0;
    part.chend = image.nchannels();
    if (part.width() <= 0 || part.height() <= 0)
        throw Refusal("the region of interest holds no pixel of the image");
    return part;
}

} // namespace tonetool
