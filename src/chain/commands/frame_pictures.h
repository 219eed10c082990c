// What the report of a check shows of the images that a command compares.
#pragma once

#include <OpenImageIO/imagebuf.h>

#include "chain/commands/commands.h"
#include "sequence/report/report_pictures.h"

namespace tonetool::chain {

/// What the images of a command take while the report looks at them; 0 without a report, and where
/// that is more than a third of the frame's memory.
uint64_t shown_bytes(const Session& session, const Call& call);

/// color_input() that reads of a file no more than its colour and alpha, since the report will look
/// at the pixels after the command; color_source() where they do not fit into --memory.
OIIO::ImageBuf shown_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options);

/// Draws the pictures of the frame, if there is a report: in full where what was found so far is
/// among the worst. The pictures are those of the first pair, else of the first image; spots are
/// added to them. What cannot be drawn is said and changes nothing of the result.
void show(Session& session, const Call& call, sequence::PictureRequest request);

} // namespace tonetool::chain
