#include "imagebuf/row_source.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <utility>

#include "imagebuf/oiio_compat.h"

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

bool RowSource::open(const ImageBuf& image, std::vector<ChannelRun> runs, std::string& error) {
    m_image = &image;
    m_runs = std::move(runs);
    m_spec = image.spec();
    m_from_file = oiio::is_unread_file(image) && OIIO::Filesystem::exists(image.name());
    if (!m_from_file)
        return true;
    m_state = state();
    m_tiles.resize(m_runs.size());
    return open_file(error);
}

bool RowSource::open_file(std::string& error) {
    const std::string name(m_image->name());
    m_input = OIIO::ImageInput::open(name);
    if (!m_input) {
        error = OIIO::geterror();
        return false;
    }
    m_spec = m_input->spec(m_image->subimage(), m_image->miplevel());
    m_format = m_input->format_name();
    if (!same_pixels(m_spec, m_image->spec())) {
        error = "the file has changed since it was opened";
        return false;
    }
    return unchanged(error);
}

RowSource::FileState RowSource::state() const {
    std::error_code ignored;
    const std::string name(m_image->name());
    return {std::filesystem::last_write_time(name, ignored),
            std::filesystem::file_size(name, ignored)};
}

bool RowSource::unchanged(std::string& error) const {
    if (state() == m_state)
        return true;
    error = "the file has changed since it was opened";
    return false;
}

int RowSource::rows_at_once(int row, size_t bytes) const {
    int channels = 1;
    for (const ChannelRun& run : m_runs)
        channels += run.count();
    const size_t row_bytes = size_t(m_spec.width) * size_t(channels) * sizeof(float);
    const int wanted = int(std::clamp<size_t>(bytes / row_bytes, 1, 1 << 20));
    const int block = m_spec.tile_width > 0 ? m_spec.tile_height : 16;
    const int past = (std::max(row, m_spec.y) - m_spec.y) % block;
    return std::max(1, std::max(wanted / block, 1) * block - past);
}

size_t RowSource::decoder_bytes() const {
    if (!m_from_file)
        return 0;
    const auto width = size_t(m_spec.width);
    const size_t pixel = m_spec.pixel_bytes(true);
    if (m_spec.tile_width > 0)
        return width * size_t(m_spec.tile_height) * pixel;
    if (m_format != "openexr")
        return 0;
    // Per thread two blocks of rows, packed and unpacked, with all channels of the file.
    const int rows = rows_per_block(m_spec.get_string_attribute("compression"));
    return size_t(oiio::exr_threads()) * 4 * size_t(rows) * width * pixel;
}

size_t RowSource::kept_bytes() const {
    size_t bytes = 0;
    if (m_from_file && m_spec.tile_width > 0)
        for (const ChannelRun& run : m_runs)
            bytes += size_t(m_spec.width) * size_t(m_spec.tile_height) * size_t(run.count()) *
                     sizeof(float);
    return bytes;
}

bool RowSource::read(int begin, int end, size_t run, float* out, std::string& error) {
    const ChannelRun& channels = m_runs[run];
    if (!m_from_file) {
        const OIIO::ROI all = m_image->roi();
        const OIIO::ROI rows(all.xbegin, all.xend, begin, end, 0, 1, channels.begin, channels.end);
        if (m_image->get_pixels(rows, OIIO::TypeFloat, out) && !m_image->has_error())
            return true;
        error = m_image->geterror();
    } else {
        if (!m_input && !open_file(error))
            return false;
        if (read_file(begin, end, run, out) && !m_input->has_error())
            return unchanged(error);
        error = m_input->geterror();
    }
    if (error.empty())
        error = "pixels could not be read";
    return false;
}

bool RowSource::read_file(int begin, int end, size_t run, float* out) {
    if (m_spec.tile_width > 0)
        return read_tiles(begin, end, run, out);
    const ChannelRun& channels = m_runs[run];
    return m_input->read_scanlines(m_image->subimage(), m_image->miplevel(), begin, end, 0,
                                   channels.begin, channels.end, OIIO::TypeFloat, out);
}

bool RowSource::read_tiles(int begin, int end, size_t run, float* out) {
    const ChannelRun& channels = m_runs[run];
    TileRows& tiles = m_tiles[run];
    const size_t row = size_t(m_spec.width) * size_t(channels.count());
    for (int y = begin; y < end;) {
        if (y < tiles.begin || y >= tiles.end) {
            const int first = y - (y - m_spec.y) % m_spec.tile_height;
            const int last = std::min(first + m_spec.tile_height, m_spec.y + m_spec.height);
            tiles.begin = tiles.end = first;
            tiles.pixels.resize(row * size_t(last - first));
            if (!m_input->read_tiles(m_image->subimage(), m_image->miplevel(), m_spec.x,
                                     m_spec.x + m_spec.width, first, last, 0, 1, channels.begin,
                                     channels.end, OIIO::TypeFloat, tiles.pixels.data()))
                return false;
            tiles.end = last;
        }
        const int until = std::min(end, tiles.end);
        const float* from = tiles.pixels.data() + size_t(y - tiles.begin) * row;
        std::copy_n(from, row * size_t(until - y), out + size_t(y - begin) * row);
        y = until;
    }
    return true;
}

void RowSource::rest() {
    if (m_from_file && m_format == "openexr")
        m_input.reset();
}

bool copy_pixels(OIIO::ImageBuf& out, const OIIO::ImageBuf& image, const OIIO::ROI& part,
                 int nthreads, std::string& error) {
    constexpr size_t kBandBytes = size_t(32) << 20;
    RowSource source;
    if (!source.open(image, {{0, image.nchannels()}}, error))
        return false;
    if (!source.from_file() || part.xbegin != source.left() || part.width() != source.width()) {
        if (OIIO::ImageBufAlgo::copy(out, image, OIIO::TypeFloat, part, nthreads))
            return true;
        error = out.geterror();
        return false;
    }
    OIIO::ImageSpec spec = image.spec();
    spec.set_format(OIIO::TypeFloat);
    spec.y = part.ybegin;
    spec.height = part.height();
    // Nobody gave it tiles yet.
    spec.tile_width = spec.tile_height = spec.tile_depth = 0;
    out.reset(spec, OIIO::InitializePixels::No);
    for (int y = part.ybegin; y < part.yend;) {
        const int end = std::min(y + source.rows_at_once(y, kBandBytes), part.yend);
        if (!source.read(y, end, 0, static_cast<float*>(out.pixeladdr(part.xbegin, y)), error))
            return false;
        y = end;
    }
    return true;
}

} // namespace tonetool
