// What --info, -v, --stats, --hash and --dumpdata print of an image, as oiiotool does.
#pragma once

#include "chain/session.h"

namespace tonetool::chain {

/// What `what` asks for of an image.
std::string listing_text(const Image& image, const Listing& what);

/// Size, channels and data type in a line, and the metadata if `detailed`.
std::string header_text(const Image& image, size_t subimage, bool detailed, bool native = false);
/// Pixel statistics, each line after `indent`.
std::string stats_text(const Image& image, const std::string& indent, size_t subimage = 0,
                       int level = 0, OIIO::ROI roi = {});

/// The same of the depth samples of a deep image.
std::string deep_stats_text(const OIIO::ImageBuf& image, const std::string& indent);
/// All samples of all pixels, and the pixels without samples.
std::string deep_dump_text(const OIIO::ImageBuf& image, bool empty_ones);

/// Prints what --info, --stats, ... ask for of a file that was just read.
void inspect_if_asked(Session& session, const Image& image);

} // namespace tonetool::chain
