// SPDX-License-Identifier: BSD-3-Clause
// Images as files of a test's own folder.
#pragma once

#include <gtest/gtest.h>

#include <OpenImageIO/filesystem.h>
#include <string>

#include "folder.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "images.h"

namespace tonetool {

/// How a file is written: float scan lines unless something else is said.
struct FileLook {
    OIIO::TypeDesc format = OIIO::TypeFloat;
    std::string compression = "zip";
    int tile = 0;
};

inline std::string write_file(const std::string& name, const ImageBuf& image,
                              const FileLook& look = {}) {
    ImageSpec spec = image.spec();
    spec.set_format(look.format);
    spec.attribute("compression", look.compression);
    spec.tile_width = spec.tile_height = look.tile;
    spec.tile_depth = look.tile > 0 ? 1 : 0;
    auto out = OIIO::ImageOutput::create(name);
    EXPECT_TRUE(out && out->open(name, spec)) << OIIO::geterror();
    EXPECT_TRUE(out->write_image(image.spec().format, image.localpixels())) << out->geterror();
    EXPECT_TRUE(out->close());
    return name;
}

/// An ImageBuf that was not read, with a cache that no other test has touched.
class UnreadFile {
public:
    explicit UnreadFile(const std::string& name, int subimage = 0)
        : m_cache(oiio::make_header_cache()),
          image(oiio::unread_file(name, subimage, m_cache)) {}
    /// Bytes of pixels that went through the cache.
    int64_t cached_bytes() const {
        long long bytes = 0;
        m_cache->getattribute("stat:bytes_read", OIIO::TypeDesc::INT64, &bytes);
        return bytes;
    }

private:
    oiio::HeaderCache m_cache;

public:
    ImageBuf image;
};

inline ImageBuf read_whole(const std::string& name, int subimage = 0) {
    ImageBuf image(name, subimage, 0);
    EXPECT_TRUE(image.read(subimage, 0, true, OIIO::TypeUnknown)) << image.geterror();
    return image;
}

} // namespace tonetool
