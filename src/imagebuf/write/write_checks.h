// SPDX-License-Identifier: BSD-3-Clause
// What writers of OpenImageIO need so that a write that fails ends, and is noticed.
#pragma once

#include <OpenImageIO/imageio.h>
#include <string>

namespace tonetool {

/// Whether the writer may write through a proxy.
bool takes_proxy(const OIIO::ImageOutput& out);

/// Reads every pixel of a file back, those of its MIP levels too: a writer that buffers may not
/// notice that its last bytes were lost.
void check_reads_back(const std::string& path, size_t subimages);

} // namespace tonetool
