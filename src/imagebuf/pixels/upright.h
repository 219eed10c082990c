// SPDX-License-Identifier: BSD-3-Clause
// How pictures are turned.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <stdexcept>

namespace tonetool {

/// The Orientation of a header, as Exif has them from 1 to 8; 1, upright, where it has none that is
/// defined.
inline int orientation_of(const OIIO::ImageSpec& header) {
    const int tag = header.get_int_attribute("Orientation", 1);
    return tag >= 1 && tag <= 8 ? tag : 1;
}

/// Its width on a screen is its height in the file.
inline bool lies_on_its_side(int orientation) {
    return orientation >= 5;
}

/// Says of a picture that was made of another that it lies as that does.
inline void lie_as(const OIIO::ImageSpec& other, OIIO::ImageBuf& picture) {
    if (orientation_of(other) != 1)
        picture.specmod().attribute("Orientation", orientation_of(other));
}

/// The picture as it is meant to be seen. A runtime_error if there is no memory for it.
inline OIIO::ImageBuf upright(OIIO::ImageBuf picture, int orientation) {
    if (orientation != 1) {
        picture.specmod().attribute("Orientation", orientation);
        picture = OIIO::ImageBufAlgo::reorient(picture);
    }
    if (picture.has_error())
        throw std::runtime_error(picture.geterror());
    return picture;
}

} // namespace tonetool
