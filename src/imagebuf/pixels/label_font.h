// SPDX-License-Identifier: BSD-3-Clause
// The font of labels. Header only: the rooms below the library's write labels, too.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <string>

namespace tonetool {

inline constexpr const char* kLabelFont = "DejaVuSans";

/// The file of that font where distributions install it, else empty.
inline std::string label_font_file() {
    for (const char* folder : {"/usr/share/fonts/truetype/dejavu/", "/usr/share/fonts/dejavu/",
                               "/usr/share/fonts/TTF/"}) {
        std::string file = folder + std::string(kLabelFont) + ".ttf";
        if (OIIO::Filesystem::is_regular(file))
            return file;
    }
    return "";
}

/// Where it is not installed, OpenImageIO may find it in folders of OPENIMAGEIO_FONTS.
inline std::string font_of_labels() {
    const std::string file = label_font_file();
    return file.empty() ? kLabelFont : file;
}

} // namespace tonetool
