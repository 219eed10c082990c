// Choosing and naming channels, in oiiotool's way of writing it.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <functional>
#include <string>

namespace tonetool::chain {

/// Takes a text that warns.
using Warn = std::function<void(const std::string&)>;

/// The channel of that name, letter case aside if need be; -1 if there is none.
int channel_index(const OIIO::ImageSpec& spec, const std::string& name);

/// "R,G=0.5,B,A=1.0": names, indices, new=old, new=value, =value; an empty one stays. A channel
/// that is not there is a CommandError with those that are; if `lenient` a warning, and 0.
OIIO::ImageBuf select_channels(const OIIO::ImageBuf& pixels, const std::string& list,
                               const Warn& lenient = nullptr);

} // namespace tonetool::chain
