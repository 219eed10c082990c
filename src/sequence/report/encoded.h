// SPDX-License-Identifier: BSD-3-Clause
// An image as the text of a data URI, to be embedded in a page.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <string>

namespace tonetool::sequence {

/// JpegMap keeps the colours of neighbours apart, for false colours. PngBytes are no colours:
/// nothing in the file says how to show them.
enum class Encoding { Jpeg, JpegMap, Png, PngBytes };

/// "data:image/jpeg;base64,...": the first three channels, display-encoded, 0 to 1. `quality` is
/// JPEG's, 1 to 100. Throws a runtime_error if it cannot be encoded.
std::string data_uri(const OIIO::ImageBuf& picture, Encoding encoding, int quality = 85);

/// The image of such a text, as 8-bit R, G, B; nullopt if the text is not an image.
std::optional<OIIO::ImageBuf> picture_of(const std::string& data_uri);

} // namespace tonetool::sequence
