// SPDX-License-Identifier: BSD-3-Clause
// What the header of a Radiance file says and OpenImageIO (2.4) does not hand over.
#pragma once

#include <optional>
#include <string>

namespace tonetool {

/// The product of all EXPOSURE lines in the header of a Radiance picture (.hdr, .pic), of whose
/// text only the lines before the first empty one count: each program that scales the pixels adds a
/// line. Nothing if `text` begins as no such file, or has no such line.
std::optional<double> radiance_exposure(const std::string& text);

} // namespace tonetool
