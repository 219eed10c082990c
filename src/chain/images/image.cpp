// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <sys/stat.h>

#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/cut_file.h"
#include "imagebuf/pixels/not_opened.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "text/error.h"
#include "text/text.h"
#include "tonetool/color_tags.h"

namespace tonetool::chain {

namespace {

DataFormat format_of(const OIIO::ImageSpec& spec) {
    return {spec.format, spec.channelformats, spec.get_int_attribute("oiio:BitsPerSample")};
}

// "shot.tone?frame=3" is a file with parameters, unless there is one of that very name.
std::string without_parameters(const std::string& name) {
    const size_t question = name.find('?');
    return question == std::string::npos || OIIO::Filesystem::exists(name)
               ? name
               : name.substr(0, question);
}

FileState state_of(const std::string& name) {
    const std::string filename = without_parameters(name);
    std::error_code ignored;
    return {std::filesystem::last_write_time(filename, ignored),
            std::filesystem::file_size(filename, ignored)};
}

std::unique_ptr<OIIO::ImageInput> open_input(const std::string& filename, const ReadOptions& how) {
    if (!OIIO::Filesystem::exists(without_parameters(filename)))
        throw CommandError("File does not exist: \"" + filename + "\"");
    std::error_code ignored;
    if (OIIO::Filesystem::exists(filename) &&
        std::filesystem::is_other(filename, ignored)) { // or a socket
        const bool pipe = std::filesystem::is_fifo(filename, ignored);
        throw CommandError("\"" + filename + "\" is a " + (pipe ? "pipe" : "device") +
                           ", which images cannot be read from");
    }
    auto input = OIIO::ImageInput::open(filename, &how.config);
    if (!input) {
        const std::string why = why_not_opened(filename, OIIO::geterror());
        const bool named = why.find(filename) != std::string::npos;
        throw CommandError(why.empty() ? "cannot read \"" + filename + "\""
                           : named     ? why
                                       : "\"" + filename + "\": " + why);
    }
    return input;
}

// Opens the file to read its pixels.
std::unique_ptr<OIIO::ImageInput> open_whole(const std::string& filename, const ReadOptions& how) {
    auto input = open_input(filename, how);
    if (const std::string why = bytes_missing(*input, filename); !why.empty())
        throw ReadError(filename, why);
    return input;
}

std::vector<OIIO::ImageSpec> level_headers(OIIO::ImageInput& input, const std::string& filename,
                                           int subimage) {
    std::vector<OIIO::ImageSpec> levels;
    while (input.seek_subimage(subimage, int(levels.size()))) {
        levels.push_back(input.spec());
        take_whole_exposure(levels.back(), filename);
    }
    (void)input.geterror();
    return levels;
}

// Compares inodes, since links name the same file.
uint64_t lineage_of_file(const std::string& filename) {
    struct stat info {};
    const bool found = ::stat(filename.c_str(), &info) == 0;
    return std::hash<std::string>()(
        found ? std::to_string(info.st_dev) + ' ' + std::to_string(info.st_ino) : filename);
}

OIIO::ImageBuf black_image(const OIIO::ImageSpec& spec, const std::string& file) {
    try {
        expect_memory(spec.deep ? 0 : spec.image_bytes());
        OIIO::ImageBuf image(spec);
        if (!spec.deep && !image.localpixels())
            throw std::bad_alloc();
        return image;
    } catch (const std::bad_alloc& failure) {
        throw CommandError("\"" + file + "\": " + memory_text(failure));
    }
}

} // namespace

Integers integers_of(const OIIO::ImageSpec& header, const std::string& file_format) {
    if (header.format.is_floating_point())
        return Integers::None;
    return oiio::encodes_with_alpha(header, file_format) ? Integers::Light : Integers::Encoded;
}

Part::Part(std::string file, int subimage, std::vector<OIIO::ImageSpec> levels, Integers integers,
           ReadOptions how)
    : m_headers(std::move(levels)),
      m_format(format_of(m_headers.front())),
      m_file(std::move(file)),
      m_state(state_of(m_file)),
      m_how(std::move(how)),
      m_subimage(subimage),
      m_integers(integers),
      m_pixels(m_headers.size()) {}

Part::Part(std::vector<OIIO::ImageBuf> levels, std::optional<DataFormat> format, Integers integers)
    : m_format(std::move(format)),
      m_integers(integers),
      m_pixels(std::move(levels)) {
    for (OIIO::ImageBuf& level : m_pixels) {
        level.specmod().erase_attribute(kStoredType); // left over from the view that it was made of
        m_headers.push_back(level.spec());
    }
}

PartPtr Part::with_headers(PartPtr source, const std::function<void(OIIO::ImageSpec&)>& edit) {
    auto part =
        std::make_shared<Part>(std::vector<OIIO::ImageBuf>(), source->m_format, source->m_integers);
    part->m_headers = source->m_headers;
    part->m_pixels.resize(source->m_pixels.size());
    std::for_each(part->m_headers.begin(), part->m_headers.end(), edit);
    part->m_source = std::move(source);
    return part;
}

PartPtr Part::of_level(PartPtr source, int level) {
    PartPtr part = with_headers(std::move(source), [](OIIO::ImageSpec&) {});
    part->m_headers = {part->header(level)};
    part->m_format.reset();
    part->m_pixels.resize(1);
    part->m_first_level = level;
    return part;
}

void Part::share(int level) {
    const OIIO::ImageBuf& pixels = m_source->pixels(m_first_level + level);
    OIIO::ImageSpec spec = header(level);
    if (pixels.deep()) {
        m_pixels[size_t(level)].copy(pixels);
        m_pixels[size_t(level)].specmod() = spec;
        return;
    }
    spec.set_format(pixels.spec().format);
    m_pixels[size_t(level)] = oiio::view_with_spec(pixels, spec);
}

const OIIO::ImageBuf& Part::pixels(int level) {
    if (!m_pixels.at(size_t(level)).initialized())
        m_source ? share(level) : read(level);
    return m_pixels[size_t(level)];
}

void Part::read_before_replacing(const std::string& filename) {
    std::error_code ignored;
    if (m_source)
        m_source->read_before_replacing(filename);
    else if (from_file() && std::filesystem::equivalent(m_file, filename, ignored))
        for (int level = 0; level < mip_levels(); ++level)
            pixels(level);
}

void Part::check_unchanged() const {
    if (!(state_of(m_file) == m_state))
        throw CommandError("\"" + m_file + "\" has changed since it was opened");
}

void Part::read(int level) {
    check_unchanged();
    auto input = open_whole(m_file, m_how);
    OIIO::ImageSpec spec = header(level);
    const OIIO::ImageSpec now = input->spec(m_subimage, level);
    if (now.roi() != spec.roi() || now.deep != spec.deep)
        throw CommandError("\"" + m_file + "\" has changed since it was opened");
    if (!spec.deep)
        spec.set_format(m_how.type == OIIO::TypeUnknown ? spec.format : m_how.type);
    OIIO::ImageBuf buffer = black_image(spec, m_file);
    bool done = spec.deep
                    ? oiio::read_deep_pixels(*input, m_subimage, level, *buffer.deepdata())
                    : oiio::read_flat_pixels(*input, m_subimage, level, spec, buffer.localpixels());
    if (!done || input->has_error())
        throw ReadError(m_file, input->geterror());
    m_pixels[size_t(level)] = std::move(buffer);
}

void Part::tag_encoding(OIIO::ImageSpec& spec) const {
    bool told = spec.find_attribute("oiio:ColorSpace") || spec.find_attribute("chromaticities");
    if (!integer_encoded())
        return;
    if (!told)
        spec.attribute("oiio:ColorSpace", "sRGB");
    // Colour that was encoded with its alpha in it is decoded so.
    if (m_integers == Integers::Encoded && !spec.find_attribute("tonemap:curve"))
        spec.attribute(kStoredType, m_format ? m_format->type.c_str() : "uint8");
}

OIIO::ImageBuf Part::color_view() {
    const OIIO::ImageBuf& buffer = pixels();
    if (buffer.deep())
        return buffer;
    OIIO::ImageSpec spec = buffer.spec();
    tag_encoding(spec);
    return oiio::view_with_spec(buffer, spec);
}

OIIO::ImageBuf Part::color_view(int begin, int end) {
    const bool ready = m_source || m_pixels.front().initialized();
    if (ready || header().deep || m_how.type != OIIO::TypeFloat)
        return color_view();
    check_unchanged();
    auto input = open_whole(m_file, m_how);
    OIIO::ImageSpec spec = header();
    spec.set_format(OIIO::TypeFloat);
    spec.nchannels = end - begin;
    spec.channelnames.resize(size_t(header().nchannels)); // some readers name fewer channels
    spec.channelnames = {spec.channelnames.begin() + begin, spec.channelnames.begin() + end};
    spec.alpha_channel = spec.z_channel = -1;
    tag_encoding(spec);
    OIIO::ImageBuf buffer = black_image(spec, m_file);
    if (input->spec(m_subimage, 0).roi() != header().roi() ||
        !oiio::read_channels(*input, m_subimage, begin, end, buffer.localpixels()))
        throw ReadError(m_file, input->geterror());
    return buffer;
}

OIIO::ImageBuf Part::color_source() {
    if (m_source || m_pixels.front().initialized() || header().deep)
        return color_view();
    check_unchanged();
    if (!m_cache) // images that were handed out before still use it
        m_cache = oiio::make_header_cache();
    OIIO::ImageBuf buffer = oiio::unread_file(m_file, m_subimage, m_cache);
    return buffer.has_error() || buffer.spec().roi() != header().roi() ? color_view()
                                                                       : std::move(buffer);
}

ImagePtr Image::open(const std::string& filename, const ReadOptions& how) {
    auto input = open_input(filename, how);
    std::vector<PartPtr> parts;
    for (int subimage = 0; input->seek_subimage(subimage, 0); ++subimage) {
        const Integers integers = integers_of(input->spec(), input->format_name());
        parts.push_back(std::make_shared<Part>(
            filename, subimage, level_headers(*input, filename, subimage), integers, how));
    }
    (void)input->geterror();
    if (parts.empty())
        throw CommandError("\"" + filename + "\" holds no image");
    auto image = std::make_shared<Image>(filename, std::move(parts));
    image->m_file_format = input->format_name();
    image->lineage = lineage_of_file(filename);
    return image;
}

size_t Image::find_part(const std::string& which, bool lenient) const {
    Strings names;
    for (const PartPtr& part : m_parts)
        names.push_back(part->header().get_string_attribute("oiio:subimagename"));
    const auto named = std::find(names.begin(), names.end(), which);
    if (named != names.end())
        return size_t(named - names.begin());
    const auto index = parse_integer(which);
    if (index && *index >= 0 && size_t(*index) < names.size())
        return size_t(*index);
    const std::string count = std::to_string(names.size());
    if (lenient) {
        throw CommandError(
            "Invalid -subimage (" + which +
            "): " + (index ? m_name + " has " + count + " subimages" : "named subimage not found"));
    }
    throw CommandError("no subimage \"" + which + "\" in " + m_name + " (valid: 0 to " +
                       std::to_string(names.size() - 1) + ", " + join(names, ", ") + ")");
}

ImagePtr Image::derived(const Image& from, std::vector<std::vector<OIIO::ImageBuf>> subimages) {
    std::vector<PartPtr> parts;
    for (std::vector<OIIO::ImageBuf>& levels : subimages) {
        const Part& source = from.part(std::min(parts.size(), from.part_count() - 1));
        std::optional<DataFormat> own = source.from_file() ? std::nullopt : source.format();
        parts.push_back(std::make_shared<Part>(std::move(levels), own, source.integers()));
    }
    return std::make_shared<Image>(from.name(), std::move(parts));
}

ImagePtr Image::derived(const Image& from, OIIO::ImageBuf pixels) {
    std::vector<std::vector<OIIO::ImageBuf>> subimages(1);
    subimages.front().push_back(std::move(pixels));
    return derived(from, std::move(subimages));
}

ImagePtr Image::created(std::string name, OIIO::ImageBuf pixels, std::optional<DataFormat> format) {
    std::vector<OIIO::ImageBuf> levels;
    levels.push_back(std::move(pixels));
    auto part = std::make_shared<Part>(std::move(levels), std::move(format), Integers::None);
    return std::make_shared<Image>(std::move(name), std::vector<PartPtr>{part});
}

ImagePtr Image::placeholder(std::string name, OIIO::ImageSpec header, bool checker) {
    const DataFormat format{header.format, {}, 0};
    header.set_format(OIIO::TypeFloat);
    header.extra_attribs.clear();
    OIIO::ImageBuf pixels(header);
    std::vector<float> black(size_t(header.nchannels), 0.0f);
    const std::vector<float> white(black.size(), 1.0f);
    if (header.alpha_channel >= 0) // only the checker's
        black[size_t(header.alpha_channel)] = 1;
    checker ? OIIO::ImageBufAlgo::checker(pixels, 64, 64, 1, black, white)
            : OIIO::ImageBufAlgo::zero(pixels);
    return created(std::move(name), std::move(pixels), format);
}

void limit_reader_threads(int most) {
    const int now = OIIO::get_int_attribute("exr_threads");
    if (most > 0)
        OIIO::attribute("exr_threads", now > 0 ? std::min(now, most) : most);
}

ImagePtr Image::computed(std::string name, OIIO::ImageBuf pixels) {
    return created(std::move(name), std::move(pixels), DataFormat{});
}

} // namespace tonetool::chain
