// Everything here that depends on the version of OpenImageIO (2.4, 2.5, 3.x).
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <memory>
#include <string>

namespace tonetool::chain {

/// An ImageBuf over pixels that `pixels` owns, with another header of the same geometry and
/// data type. It is valid as long as `pixels` is.
inline OIIO::ImageBuf view_with_spec(const OIIO::ImageBuf& pixels, const OIIO::ImageSpec& spec) {
    return OIIO::ImageBuf(spec, const_cast<void*>(pixels.localpixels()));
}

/// A cache for one file: it holds the file's header, and not the one that some other cache has kept
/// of an older file of that name.
using HeaderCache = std::shared_ptr<OIIO::ImageCache>;

inline HeaderCache make_header_cache() {
#if OIIO_VERSION >= 30000 // shares its caches itself
    return OIIO::ImageCache::create(false);
#else
    return {OIIO::ImageCache::create(false),
            [](OIIO::ImageCache* cache) { OIIO::ImageCache::destroy(cache); }};
#endif
}

/// An ImageBuf that knows the header of a subimage and reads no pixel. It is valid as long as the
/// cache is.
inline OIIO::ImageBuf unread_file(const std::string& file, int subimage, const HeaderCache& cache) {
#if OIIO_VERSION >= 30000
    OIIO::ImageBuf buffer(file, subimage, 0, cache);
#else
    OIIO::ImageBuf buffer(file, subimage, 0, cache.get());
#endif
    cache->close_all();
    return buffer;
}

/// Read one subimage in the data type of `spec` into `buffer`.
inline bool read_flat_pixels(OIIO::ImageInput& input, int subimage, int level,
                             const OIIO::ImageSpec& spec, void* buffer) {
    return input.read_image(subimage, level, 0, spec.nchannels, spec.format, buffer);
}

/// Read the channels from `begin` to before `end` of one subimage as floats into `buffer`.
inline bool read_channels(OIIO::ImageInput& input, int subimage, int begin, int end, void* buffer) {
    return input.read_image(subimage, 0, begin, end, OIIO::TypeFloat, buffer);
}

inline bool read_deep_pixels(OIIO::ImageInput& input, int subimage, int level,
                             OIIO::DeepData& data) {
    return input.read_native_deep_image(subimage, level, data);
}

/// What a format can hold ("alpha", "nchannels", "displaywindow", ...).
inline bool format_supports(const OIIO::ImageOutput& output, const std::string& feature) {
    return output.supports(feature) != 0;
}

} // namespace tonetool::chain
