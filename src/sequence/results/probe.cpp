// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/probe.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>

#include "imagebuf/pixels/guard.h"
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

// The display window of the first subimage; nullopt with the reason where the file cannot be read
// to its end.
std::optional<Size> readable(const std::string& file, std::string& why) {
    std::error_code ignored;
    if (std::filesystem::is_other(file, ignored)) {
        why = "it is a pipe or a device";
        return std::nullopt;
    }
    if (std::FILE* opened = std::fopen(file.c_str(), "rb")) {
        std::fclose(opened);
    } else { // which readers call a file of another format
        why = std::strerror(errno);
        return std::nullopt;
    }
    const auto in = OIIO::ImageInput::open(file);
    if (!in) {
        why = OIIO::geterror();
        if (std::filesystem::file_size(file, ignored) == 0)
            why += ": it is empty (0 bytes)";
        return std::nullopt;
    }
    const Size size{in->spec().full_width, in->spec().full_height};
    for (int subimage = 0; in->seek_subimage(subimage, 0); ++subimage) {
        const OIIO::ImageSpec spec = in->spec(subimage, 0);
        OIIO::DeepData deep;
        const bool read = spec.deep ? in->read_native_deep_image(subimage, 0, deep)
                                    : read_rows(*in, subimage, spec);
        if (!read || in->has_error()) { // JPEG and TIFF go on beyond the end, with an error
            why = in->geterror();
            return std::nullopt;
        }
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
        std::optional<Size> size;
        const bool read = contained(why, [&] {
            std::string reason;
            size = readable(file, reason);
            if (!size)
                throw Refusal(reason);
        });
        if (!read) {
            return {Status::Unreadable,
                    format("cannot read \"{}\": {}", file, why.substr(0, why.find('\n')))};
        }
        if (first && *first != *size) {
            found = {Status::SizeMismatch,
                     format("\"{}\" is {}x{}, \"{}\" {}x{}", files.front(), first->width,
                            first->height, file, size->width, size->height)};
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
