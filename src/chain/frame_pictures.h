// What the report of a check shows of the images that a command compares.
#pragma once

#include <OpenImageIO/imagebuf.h>

#include "chain/call.h"
#include "chain/session.h"
#include "sequence/report_pictures.h"

namespace tonetool::chain {

/// color_input() that reads of a file no more than its colour and alpha, since the report will look
/// at the pixels after the command; color_source() where they do not fit into --memory.
OIIO::ImageBuf shown_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options);

/// Draws the pictures of the frame, if there is a report and no command before has drawn them: in
/// full where the measurements so far are among the worst. What cannot be drawn is said and changes
/// nothing of the result.
void show(Session& session, const Call& call, sequence::PictureRequest request);

} // namespace tonetool::chain
