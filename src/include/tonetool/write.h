// Writing images so that a failed or interrupted run never harms what was there.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "tonetool/export.h"

namespace tonetool {

/// Pixels and how they are to be written: `spec` is the image's own with the data format
/// (spec.format, spec.channelformats), compression, tiling and metadata of the file.
/// ImageBuf::set_write_format cannot be read back and has no say here.
struct OutputImage {
    const OIIO::ImageBuf* pixels = nullptr;
    OIIO::ImageSpec spec;
    bool mip_level = false;    ///< the next smaller level of the image before it
    std::string format_name{}; ///< instead of the one that the extension tells
    bool upright = true;       ///< turned where its Orientation is one that the format cannot say
};

/// Write images (one: a plain file; several: subimages) to `filename`.
///
/// The bytes go to a temporary file beside the target, are flushed to the disk and renamed into
/// place, so that the target is either the old file or the whole new one. Every byte's write is
/// checked: a full disk is an error. A symbolic link is followed; a device or pipe is written
/// directly. The format follows the extension. An image whose `Orientation` (of its spec) the
/// format cannot say is written upright: all but EXR, TIFF, JPEG, DPX and FITS. Returns false and
/// explains in `error`; then nothing has changed on disk.
TONETOOL_API bool write_images(const std::vector<OutputImage>& images, const std::string& filename,
                               std::string& error);

/// One image, in the data format of its spec.
TONETOOL_API bool write_image(const OIIO::ImageBuf& image, const std::string& filename,
                              std::string& error);

/// What is done where the target is a symbolic link: its file is replaced, or it is an error.
enum class Links { Follow, Refuse };

/// The same promise for a text or any other bytes.
TONETOOL_API bool write_bytes(const std::string& bytes, const std::string& filename,
                              std::string& error, Links links = Links::Follow);

/// Remove what processes that were killed while they wrote these files have left beside them; not
/// what a process still writes.
TONETOOL_API void remove_abandoned_outputs(const std::vector<std::string>& filenames);

/// Remove the temporary files of writes now under way. Safe to call from a signal handler.
TONETOOL_API void remove_unfinished_outputs() noexcept;

} // namespace tonetool
