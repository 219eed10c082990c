// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/probe.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <filesystem>
#include <optional>

#include "imagebuf/pixels/cut_file.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/not_opened.h"
#include "imagebuf/pixels/rows_together.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

bool read_rows(OIIO::ImageInput& in, int subimage, const OIIO::ImageSpec& spec) {
    const int rows_at_once = whole_rows(64, spec, in.format_name());
    std::vector<unsigned char> pixels;
    if (spec.depth > 1 || spec.tile_width > 0) {
        expect_memory(spec.image_bytes(true));
        pixels.resize(spec.image_bytes(true));
        return in.read_image(subimage, 0, 0, spec.nchannels, OIIO::TypeUnknown, pixels.data());
    }
    for (int y = spec.y; y < spec.y + spec.height; y += rows_at_once) {
        const int end = std::min(y + rows_at_once, spec.y + spec.height);
        pixels.resize(size_t(end - y) * spec.scanline_bytes(true));
        if (!in.read_scanlines(subimage, 0, y, end, 0, 0, spec.nchannels, OIIO::TypeUnknown,
                               pixels.data()))
            return false;
    }
    return true;
}

struct Size {
    int width, height;
    bool operator!=(const Size& o) const { return width != o.width || height != o.height; }
};

// Reads a file to its end. Returns the display window of its first subimage.
Size read_to_the_end(const std::string& file) {
    std::error_code ignored;
    if (std::filesystem::is_other(file, ignored))
        throw Refusal("it is a pipe or a device");
    const auto in = OIIO::ImageInput::open(file);
    if (!in)
        throw Refusal(why_not_opened(file, OIIO::geterror()));
    if (const std::string why = bytes_missing(*in, file); !why.empty())
        throw Refusal(why);
    const Size size{in->spec().full_width, in->spec().full_height};
    for (int subimage = 0; in->seek_subimage(subimage, 0); ++subimage) {
        const OIIO::ImageSpec spec = in->spec(subimage, 0);
        OIIO::DeepData deep;
        const bool read = spec.deep ? in->read_native_deep_image(subimage, 0, deep)
                                    : read_rows(*in, subimage, spec);
        if (!read || in->has_error()) // JPEG and TIFF go on beyond the end, with an error
            throw Refusal(in->geterror());
    }
    return size;
}

} // namespace

Probe missing_of(const std::vector<std::string>& files) {
    for (const std::string& file : files)
        if (!OIIO::Filesystem::exists(file))
            return {Status::Missing, format("no file \"{}\"", file)};
    return {};
}

Probe probed(const std::vector<std::string>& files) {
    Probe found = missing_of(files);
    if (found.status == Status::Missing)
        return found;
    std::optional<Size> first;
    for (const std::string& file : files) {
        std::string why;
        Size size{};
        if (!contained(why, [&] { size = read_to_the_end(file); })) {
            return {Status::Unreadable,
                    format("cannot read \"{}\": {}", file, why.substr(0, why.find('\n')))};
        }
        if (first && *first != size) {
            found = {Status::SizeMismatch,
                     format("\"{}\" is {}x{}, \"{}\" {}x{}", files.front(), first->width,
                            first->height, file, size.width, size.height)};
        }
        first = first ? first : size;
    }
    return found;
}

void settle(FrameResult& frame, const std::string& error, const std::vector<std::string>& files) {
    frame.status = Status::Passed;
    if (!error.empty()) {
        const Probe found = probed(files);
        frame.status = found.status;
        frame.message = found.message.empty() ? error : found.message;
    }
    judge(frame);
}

} // namespace tonetool::sequence
