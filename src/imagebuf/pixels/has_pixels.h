// SPDX-License-Identifier: BSD-3-Clause
// Whether an image holds what it says it holds, how it is read whole, and the words for it if not.
// Header only: the command language and the module of Python use it, too.
#pragma once

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/filesystem.h>
#include <new>
#include <string>

#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/cut_file.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "metrics/refusal.h"

namespace tonetool {

/// Whether the pixels of an image are still in its file, which can be read again.
inline bool is_file_to_read(const OIIO::ImageBuf& image) {
    return oiio::is_unread_file(image) && OIIO::Filesystem::exists(image.name());
}

/// Whether the pixels that an image should have in memory are there: a read that failed leaves the
/// memory, and an error that is gone once somebody has asked for it.
inline bool has_pixels(const OIIO::ImageBuf& image) {
    return oiio::is_unread_file(image) || image.deep() || image.pixels_valid();
}

/// What a reader said, after the name of the file unless it says that itself.
inline std::string with_name(const OIIO::ImageBuf& image, const std::string& why) {
    const std::string name(image.name());
    return name.empty() || why.find(name) != std::string::npos ? why : "\"" + name + "\": " + why;
}

/// Reads an image that is still in its file, as numbers of a type, by a reader of its own: neither
/// an ImageCache nor ImageBuf::read tells of all pixels that are missing. A Refusal names the file.
inline OIIO::ImageBuf read_whole(const OIIO::ImageBuf& image, OIIO::TypeDesc type) {
    const auto fail = [&](const std::string& why) {
        throw Refusal(with_name(image, why.empty() ? "pixels could not be read" : why));
    };
    const auto in = oiio::open_input(std::string(image.name()));
    if (!in)
        fail(OIIO::geterror());
    if (const std::string why = bytes_missing(*in, std::string(image.name())); !why.empty())
        fail(why);
    OIIO::ImageSpec spec = image.spec();
    const OIIO::ImageSpec now = in->spec(image.subimage(), image.miplevel());
    if (now.roi() != spec.roi() || now.deep || spec.deep)
        fail("the file has changed since it was opened");
    spec.set_format(type);
    spec.tile_width = now.tile_width; // not those of an ImageCache
    spec.tile_height = now.tile_height;
    spec.tile_depth = now.tile_depth;
    try {
        OIIO::ImageBuf whole = allocated_image(spec);
        if (!in->read_image(image.subimage(), image.miplevel(), 0, spec.nchannels, type,
                            whole.localpixels()) ||
            in->has_error())
            fail(in->geterror());
        return whole;
    } catch (const std::bad_alloc& failure) {
        throw Refusal(with_name(image, memory_text(failure)));
    }
}

} // namespace tonetool
