// What --info and --stats print, in oiiotool's words.
#pragma once

#include <string>

#include "chain/session.h"

namespace tonetool::chain {

/// One line: name, size, channels, data types, format; `verbose` adds the metadata.
std::string info_text(const Image& image, bool verbose);

/// Minimum, maximum, average, ... of the first subimage, per channel.
std::string stats_text(const Image& image);

/// Print what the session's --info, -v and --stats ask for about an image just read.
void inspect_if_asked(Session& session, const Image& image);

} // namespace tonetool::chain
