// Everything here that depends on the version of OpenImageIO (2.4, 2.5, 3.x).
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>
#include <memory>
#include <string>

namespace tonetool::chain {

/// An ImageBuf over pixels that `pixels` owns, with another header of the same geometry and
/// data type. It is valid as long as `pixels` is.
inline OIIO::ImageBuf view_with_spec(const OIIO::ImageBuf& pixels, const OIIO::ImageSpec& spec) {
    return OIIO::ImageBuf(spec, const_cast<void*>(pixels.localpixels()));
}

/// Read one subimage as float into `buffer`.
inline bool read_float_pixels(OIIO::ImageInput& input, int subimage, int channels, void* buffer) {
    return input.read_image(subimage, 0, 0, channels, OIIO::TypeFloat, buffer);
}

inline bool read_deep_pixels(OIIO::ImageInput& input, int subimage, OIIO::DeepData& data) {
    return input.read_native_deep_image(subimage, 0, data);
}

/// What a format can hold ("alpha", "nchannels", "displaywindow", ...).
inline bool format_supports(const OIIO::ImageOutput& output, const std::string& feature) {
    return output.supports(feature) != 0;
}

} // namespace tonetool::chain
