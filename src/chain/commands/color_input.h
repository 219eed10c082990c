// Images as the library's measuring functions take them.
#pragma once

#include "chain/commands/commands.h"
#include "tonetool/parts.h"

namespace tonetool::chain {

/// The part of an image that a command looks at: that of the layer, the view or the name in the
/// options, else the beauty. Where others have a picture, too, that nobody looks at, this is an
/// error of commands that end in a verdict, and a warning of others; with -a commands that compare
/// refuse images of several parts.
Part& color_part(Session& session, const Call& call, const Image& image,
                 const PixelOptions& options);

/// A CommandError if commands before have left out parts of the image that have a picture.
void check_nothing_left_out(const Image& image);

/// The headers of all parts, as find_part() takes them.
std::vector<OIIO::ImageSpec> headers_of(const Image& image);

/// Whether the parts of these numbers came from one place of one file, by whatever names and links.
bool same_file(const Image& a, size_t part_of_a, const Image& b, size_t part_of_b);

/// color_part(), whose tag of a space and whose layer must be known: messages name the image.
Part& checked_part(Session& session, const Call& call, const Image& image,
                   const PixelOptions& options);

/// What its header says of the encoding, beyond the colour space: the gamma and the EXPOSURE that
/// are applied are told, an ICC profile that is not is a warning.
void tell_encoding(Session& session, const Call& call, const Image& image,
                   const OIIO::ImageSpec& header, const PixelOptions& options);

/// The pixels of color_part() and a header that tells display-encoded integers from linear floats.
OIIO::ImageBuf color_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options);

/// As color_input(), unread where the library may read what it needs of the file by itself.
OIIO::ImageBuf color_source(Session& session, const Call& call, const Image& image,
                            const PixelOptions& options);

} // namespace tonetool::chain
