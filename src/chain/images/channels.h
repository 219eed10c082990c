// SPDX-License-Identifier: BSD-3-Clause
// Choosing and naming channels, in oiiotool's way of writing it.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <functional>
#include <string>

namespace tonetool::chain {

/// Receives the text of a warning.
using Warn = std::function<void(const std::string&)>;

/// The channel of that name, else one that differs only in letter case; -1 if there is none.
int channel_index(const OIIO::ImageSpec& spec, const std::string& name);

/// "R,G=0.5,B,A=1.0": names, indices, new=old, new=value, =value; an empty one keeps its channel. A
/// missing channel is a CommandError that lists the existing ones; if `lenient`, it is a warning
/// and the channel is filled with 0.
OIIO::ImageBuf select_channels(const OIIO::ImageBuf& pixels, const std::string& list,
                               const Warn& lenient = nullptr);

} // namespace tonetool::chain
