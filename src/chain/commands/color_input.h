// SPDX-License-Identifier: BSD-3-Clause
// Converts images of the stack to the inputs of the library's measuring functions.
#pragma once

#include <optional>

#include "chain/commands/commands.h"
#include "tonetool/parts.h"

namespace tonetool::chain {

/// The subimage of an image that a command reads: the one with the layer, the view or the name in
/// the options, else the beauty. If other subimages have a beauty, too, which would be left out,
/// this is an error in commands that end in a verdict, and a warning in others; with -a, commands
/// that compare refuse images of several subimages.
Part& color_part(Session& session, const Call& call, const Image& image,
                 const PixelOptions& options);

/// Throws a CommandError if earlier commands have left out subimages that have a beauty.
void check_nothing_left_out(const Image& image);

/// The headers of all subimages, as find_part() takes them.
std::vector<OIIO::ImageSpec> headers_of(const Image& image);

/// Whether the subimages with these indices are the same subimage of the same file, by whatever
/// names and links.
bool same_file(const Image& a, size_t part_of_a, const Image& b, size_t part_of_b);

/// Says that two images that are compared are the same file: a slip of the command line that no
/// limit finds. An error where every frame of a check would be compared with itself by one name,
/// a warning elsewhere: versions may have links to each other's files.
void tell_same_file(Session& session, const Call& call, const Image& a, const Image& b,
                    const std::string& text);

/// color_part() with a check that its colour space and its layer are known; messages name the
/// image.
Part& checked_part(Session& session, const Call& call, const Image& image,
                   const PixelOptions& options);

/// Reports the parts of the encoding beyond the colour space: the gamma and the EXPOSURE, which are
/// applied, and as a warning an ICC profile, which is not.
void tell_encoding(Session& session, const Call& call, const Image& image,
                   const OIIO::ImageSpec& header, const PixelOptions& options);

/// The subimage and the channels that a command looks at, as find_part() and find_color() choose
/// them.
struct LookedAt {
    size_t part = 0;
    OIIO::ImageSpec header; ///< of the subimage
    ColorChoice color;
};
std::optional<LookedAt> looked_at(const Image& image, const PixelOptions& options);

/// For images whose pictures are compared, where no layer is asked for: that of one must not be of
/// another name than that of the other while the other has a layer of its name. An error in
/// commands that end in a verdict, and a warning in others.
void check_same_picture(Session& session, const Call& call, const Image& reference,
                        const PixelOptions& of_reference, const Image& test,
                        const PixelOptions& of_test);

/// The pixels of color_part(), with a header that distinguishes display-encoded integers from
/// linear floats.
OIIO::ImageBuf color_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options);

/// Pushes what a command has made of color_part(). With -a the other subimages are carried.
void push_picture(Session& session, const Image& image, const PixelOptions& options,
                  OIIO::ImageBuf result);

/// As color_input(), but unread where the library may read the file by itself.
OIIO::ImageBuf color_source(Session& session, const Call& call, const Image& image,
                            const PixelOptions& options);

} // namespace tonetool::chain
