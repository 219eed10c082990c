// SPDX-License-Identifier: BSD-3-Clause
// What --info, -v, --stats, --hash and --dumpdata print of an image, as oiiotool does.
#pragma once

#include <optional>
#include <string>

#include "chain/images/image.h"

namespace tonetool::chain {

/// The choice of what is printed about an image that is read: --info, --stats, --hash, --dumpdata.
struct Listing {
    bool info = false, verbose = false, all_subimages = false, hash = false, stats = false;
    bool named = true;   ///< describe a file, in its own data type; else pixels in memory
    bool native = false; ///< show pixels in memory with the data type of their file
    std::string format, metamatch, no_metamatch; ///< "xml"; lines that (do not) match
    std::optional<std::string> dump;             ///< name of a C array, or "" for plain text
    bool dump_black = true;
    OIIO::ROI roi{}; ///< region of the statistics
};

/// Prints what `what` asks for.
std::string listing_text(const Image& image, const Listing& what);

/// Size, channels and data type in a line, and the metadata if `detailed`.
std::string header_text(const Image& image, size_t subimage, bool detailed, bool native = false);
/// Pixel statistics, each line after `indent`.
std::string stats_text(const Image& image, const std::string& indent, size_t subimage = 0,
                       int level = 0, OIIO::ROI roi = {});

/// SHA-1 of the values of a subimage in the file's data types; for a deep image, of the numbers of
/// samples and of all samples.
std::string stored_hash(const std::string& file, int subimage);

/// The same for the depth samples of a deep image.
std::string deep_stats_text(const OIIO::ImageBuf& image, const std::string& indent);
/// Prints all samples of all pixels, and the pixels without samples.
std::string deep_dump_text(const OIIO::ImageBuf& image, bool empty_ones);

/// The image formats and their extensions; without recipes if `lenient`, as oiiotool.
std::string formats_text(bool lenient);

} // namespace tonetool::chain
