// A picture as text, to stand in a page.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <string>

namespace tonetool::sequence {

/// JpegMap keeps the colours of neighbours apart, for false colours.
enum class Encoding { Jpeg, JpegMap, Png };

/// "data:image/jpeg;base64,...": the first three channels, display-encoded, 0 to 1. `quality` is
/// JPEG's, 1 to 100. A runtime_error if it cannot be encoded.
std::string data_uri(const OIIO::ImageBuf& picture, Encoding encoding, int quality = 85);

/// The picture of such a text, as 8-bit R, G, B; nullopt if it is none.
std::optional<OIIO::ImageBuf> picture_of(const std::string& data_uri);

} // namespace tonetool::sequence
