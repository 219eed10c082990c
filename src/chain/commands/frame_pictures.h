// SPDX-License-Identifier: BSD-3-Clause
// The images of a command in the report of a check.
#pragma once

#include <OpenImageIO/imagebuf.h>

#include "chain/commands/commands.h"
#include "sequence/report/report_pictures.h"

namespace tonetool::chain {

/// The memory that the images of a command take while the report reads them; 0 without a report,
/// and where that is more than a third of the frame's memory.
uint64_t shown_bytes(const Session& session, const Call& call);

/// As color_input(), but reads only colour and alpha of a file, since the report needs the pixels
/// after the command; as color_source() if they do not fit into --memory.
OIIO::ImageBuf shown_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options);

/// Draws the images of the frame if there is a report: in full if the results so far are among the
/// worst. The images are those of the first pair, else of the first image; spots of later commands
/// are added. A failure to draw is reported and does not change the result.
void show(Session& session, const Call& call, sequence::PictureRequest request);

} // namespace tonetool::chain
