// SPDX-License-Identifier: BSD-3-Clause
// Writing images so that a failed or interrupted run never harms the file that was there.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <functional>
#include <string>
#include <vector>

#include "tonetool/export.h"

namespace tonetool {

/// Pixels and how they are to be written: `spec` is the image's own with the data format
/// (spec.format, spec.channelformats), compression, tiling and metadata of the file.
/// ImageBuf::set_write_format cannot be read back and has no effect here.
struct OutputImage {
    const OIIO::ImageBuf* pixels = nullptr;
    OIIO::ImageSpec spec;
    bool mip_level = false;    ///< the next smaller level of the image before it
    std::string format_name{}; ///< file format that replaces the one of the extension
    bool upright = true;       ///< rotate the pixels where the format cannot store the Orientation
};

/// Write images (one: a plain file; several: subimages) to `filename`.
///
/// The bytes go to a temporary file beside the target, are flushed to the disk and renamed into
/// place, so that the target is either the old file or the whole new one. Every byte's write is
/// checked: a full disk is an error. A symbolic link is followed; a device or pipe is written
/// directly. The format follows the extension. An image whose `Orientation` the format cannot store
/// is written upright: all formats but EXR, TIFF, JPEG, DPX and FITS. Returns false and explains in
/// `error`; then nothing has changed on disk.
TONETOOL_API bool write_images(const std::vector<OutputImage>& images, const std::string& filename,
                               std::string& error);

/// One image, in the data format of its spec.
TONETOOL_API bool write_image(const OIIO::ImageBuf& image, const std::string& filename,
                              std::string& error);

/// The treatment of a target that is a symbolic link: its file is replaced, or it is an error.
enum class Links { Follow, Refuse };

/// The same promise for a text or any other bytes.
TONETOOL_API bool write_bytes(const std::string& bytes, const std::string& filename,
                              std::string& error, Links links = Links::Follow);
/// In pieces, which `put` gives to what it is called with, for what is not to be in memory at once.
TONETOOL_API bool
write_bytes(const std::function<void(const std::function<void(const std::string& piece)>&)>& put,
            const std::string& filename, std::string& error);

/// Remove the temporary files beside these targets that killed processes have left; those that a
/// process still writes stay.
TONETOOL_API void remove_abandoned_outputs(const std::vector<std::string>& filenames);

/// Remove the temporary files of all writes that are under way in this process. Safe to call from a
/// signal handler.
TONETOOL_API void remove_unfinished_outputs() noexcept;

} // namespace tonetool
