// SPDX-License-Identifier: BSD-3-Clause
// What OpenImageIO looks for in the file tone.imageio.so: every name begins as the file's does.
#include "tone.imageio/tone_input.h"
#include "tonetool/export.h"

OIIO_PLUGIN_EXPORTS_BEGIN

OIIO_EXPORT int tone_imageio_version = OIIO_PLUGIN_VERSION;

OIIO_EXPORT const char* tone_imageio_library_version() {
    return "tonetool " TONETOOL_VERSION;
}

OIIO_EXPORT OIIO::ImageInput* tone_input_imageio_create() {
    return tonetool::create_tone_input();
}

OIIO_EXPORT const char* tone_input_extensions[] = {"tone", nullptr};

OIIO_PLUGIN_EXPORTS_END
