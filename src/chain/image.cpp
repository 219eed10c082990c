#include "chain/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "chain/error.h"
#include "chain/oiio_compat.h"

namespace tonetool::chain {

namespace {

DataFormat format_of(const OIIO::ImageSpec& spec) {
    return {spec.format, spec.channelformats, spec.get_int_attribute("oiio:BitsPerSample")};
}

FileState state_of(const std::string& filename) {
    std::error_code ignored;
    return {std::filesystem::last_write_time(filename, ignored),
            std::filesystem::file_size(filename, ignored)};
}

std::unique_ptr<OIIO::ImageInput> open_input(const std::string& filename) {
    if (!OIIO::Filesystem::exists(filename)) {
        throw CommandError("File does not exist: \"" + filename + "\"");
    }
    std::error_code ignored;
    if (std::filesystem::is_fifo(filename, ignored)) {
        throw CommandError("\"" + filename + "\" is a pipe, which images cannot be read from");
    }
    auto input = OIIO::ImageInput::open(filename);
    if (!input) {
        std::string why = OIIO::geterror();
        throw CommandError(why.empty() ? "cannot read \"" + filename + "\"" : why);
    }
    return input;
}

int count_mip_levels(OIIO::ImageInput& input, int subimage) {
    int level = 1;
    while (input.seek_subimage(subimage, level)) {
        ++level;
    }
    (void)input.geterror();
    return level;
}

} // namespace

Part::Part(std::string file, int subimage, int mip_levels, const OIIO::ImageSpec& header)
    : m_header(header),
      m_format(format_of(header)),
      m_file(std::move(file)),
      m_state(state_of(m_file)),
      m_subimage(subimage),
      m_mip_levels(mip_levels),
      m_integer_encoded(!header.format.is_floating_point()) {}

Part::Part(OIIO::ImageBuf pixels, DataFormat format, bool integer_encoded)
    : m_header(pixels.spec()),
      m_format(std::move(format)),
      m_integer_encoded(integer_encoded),
      m_read(true),
      m_pixels(std::move(pixels)) {}

const OIIO::ImageBuf& Part::pixels() {
    if (!m_read) {
        read();
        m_read = true;
    }
    return m_pixels;
}

void Part::read_before_replacing(const std::string& filename) {
    std::error_code ignored;
    if (!m_read && std::filesystem::equivalent(m_file, filename, ignored)) {
        pixels();
    }
}

void Part::check_unchanged() const {
    if (!(state_of(m_file) == m_state)) {
        throw CommandError("\"" + m_file + "\" has changed since it was opened");
    }
}

void Part::read() {
    check_unchanged();
    auto input = open_input(m_file);
    const OIIO::ImageSpec now = input->spec(m_subimage, 0);
    if (now.roi() != m_header.roi() || now.deep != m_header.deep) {
        throw CommandError("\"" + m_file + "\" has changed since it was opened");
    }
    OIIO::ImageSpec spec = m_header;
    bool done = false;
    if (spec.deep) {
        m_pixels.reset(spec);
        done = read_deep_pixels(*input, m_subimage, *m_pixels.deepdata());
    } else {
        spec.set_format(OIIO::TypeFloat);
        m_pixels.reset(spec);
        if (!m_pixels.localpixels()) {
            throw CommandError("not enough memory for \"" + m_file + "\"");
        }
        done = read_float_pixels(*input, m_subimage, spec.nchannels, m_pixels.localpixels());
    }
    if (!done || input->has_error()) {
        std::string why = input->geterror();
        throw CommandError("cannot read the pixels of \"" + m_file + "\"" +
                           (why.empty() ? "" : ": " + why));
    }
}

OIIO::ImageBuf Part::color_view() {
    const OIIO::ImageBuf& buffer = pixels();
    OIIO::ImageSpec spec = buffer.spec();
    bool told = spec.find_attribute("oiio:ColorSpace") || spec.find_attribute("chromaticities");
    if (spec.deep) {
        return buffer;
    }
    if (m_integer_encoded && !told) {
        spec.attribute("oiio:ColorSpace", "sRGB");
    }
    return view_with_spec(buffer, spec);
}

OIIO::ImageBuf Part::color_source() {
    if (m_read || m_header.deep) {
        return color_view();
    }
    check_unchanged();
    m_cache = make_header_cache();
    OIIO::ImageBuf buffer = unread_file(m_file, m_subimage, m_cache);
    return buffer.has_error() || buffer.spec().roi() != m_header.roi() ? color_view()
                                                                       : std::move(buffer);
}

ImagePtr Image::open(const std::string& filename) {
    auto input = open_input(filename);
    std::vector<PartPtr> parts;
    for (int subimage = 0; input->seek_subimage(subimage, 0); ++subimage) {
        OIIO::ImageSpec header = input->spec();
        int levels = count_mip_levels(*input, subimage);
        parts.push_back(std::make_shared<Part>(filename, subimage, levels, header));
    }
    (void)input->geterror();
    if (parts.empty()) {
        throw CommandError("\"" + filename + "\" holds no image");
    }
    auto image = std::make_shared<Image>(filename, std::move(parts));
    image->m_file_format = input->format_name();
    return image;
}

ImagePtr Image::derived(const Image& from, OIIO::ImageBuf pixels) {
    const Part& first = from.part();
    DataFormat format = first.format();
    format.of_channel.clear();
    auto part = std::make_shared<Part>(std::move(pixels), format, first.integer_encoded());
    return std::make_shared<Image>(from.name(), std::vector<PartPtr>{part});
}

ImagePtr Image::computed(std::string name, OIIO::ImageBuf pixels) {
    DataFormat format{OIIO::TypeFloat, {}, 0};
    auto part = std::make_shared<Part>(std::move(pixels), format, false);
    return std::make_shared<Image>(std::move(name), std::vector<PartPtr>{part});
}

} // namespace tonetool::chain
