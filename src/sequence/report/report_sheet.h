// SPDX-License-Identifier: BSD-3-Clause
// The contact sheet: every frame as a thumbnail with its number and status.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

#include "sequence/report/report_store.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

inline constexpr size_t kMostSheetFrames = 400;

/// R, G, B, sRGB-encoded, in the order of the frames. Of more than `most_sheet_frames` frames the
/// worst are shown. `warning` says so, or that no font was found for the labels. Throws a
/// runtime_error if nothing can be drawn.
OIIO::ImageBuf contact_sheet(const ShotResult& shot, const PictureStore& pictures,
                             std::string& warning);

} // namespace tonetool::sequence
