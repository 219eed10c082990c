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

/// Prints what --info, --stats, ... ask for of a file that was just read.
void inspect_if_asked(Session& session, const Image& image);

} // namespace tonetool::chain
