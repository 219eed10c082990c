// Choosing and naming channels, in oiiotool's way of writing it.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

namespace tonetool::chain {

struct Session;

/// The channel of that name, letter case aside if need be; -1 if there is none.
int channel_index(const OIIO::ImageSpec& spec, const std::string& name);

/// "R,G=0.5,B,A=1.0": names, indices, new=old, new=value, =value; an empty one stays. A channel
/// that is not there is a CommandError with those that are; with --compat a warning, and 0.
OIIO::ImageBuf select_channels(const OIIO::ImageBuf& pixels, const std::string& list,
                               Session* session = nullptr);

} // namespace tonetool::chain
