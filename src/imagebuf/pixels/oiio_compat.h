// SPDX-License-Identifier: BSD-3-Clause
// All that differs between OpenImageIO 2.4, 2.5 and 3.x for this project, in one place.
//
//   ImageCache      3.0 hands it out as a shared_ptr, and ImageBuf takes that; 2.x as a pointer to
//                   be destroyed.
//   resize, fit     3.0 takes their parameters as KWArgs; the lists of parameters of 2.x are on
//                   their way out.
//   thread pool     2.4 does not look at the number of threads for chunks of one.
//   ociodisplay     2.4 drops `looks` without a word; 2.5 adds `inverse`.
//   colour spaces   2.5 knows which names mean the same space; 2.4 compares them. 3.1 calls what
//                   a file's name does not tell "unknown", and sRGB "srgb_rec709_scene".
//   capture_image   3.0 leaves it to programs that are linked with OpenCV themselves.
//   supports()      of readers and writers: an int in all of them, a string_view goes in.
//   plugins         OIIO_PLUGIN_VERSION is 25 in 2.4 and 2.5, 27 in 3.x; the macros name it. The
//                   folders are in OIIO_LIBRARY_PATH, for 3.x in OPENIMAGEIO_PLUGIN_PATH.
//   PNM files       2.5 writes all of them from the last row to the first, as only those of floats
//                   are; it reads those of floats that way too, unless they are opened with a
//                   configuration. 2.4 writes 8 bits whatever is asked for, 2.5 16 and floats too.
//   PNG files       2.5.14 multiplies light by alpha, and encodes it again; before, the encoded
//                   values were multiplied, by the power of the file's gamma, as those of Targa
//                   files are in all of them; 3.1 multiplies them by alpha itself.
//   ImageBuf(name)  2.5 reads the pixels at once, 3.x when somebody asks for them; in 2.4 they stay
//                   in the file, behind an ImageCache.
//   fonts           2.5 looks for them by name in a few folders, not in those below.
//   origins         2.5 numbers rows from 0 in formats that have no origin, 2.4 from the image's.
//   names           TypeFloat, TypeInt, TypeString, paropt, parallel_for_chunked, Strutil::fmt and
//                   string_view are spelt the same in all of them.
#pragma once

#include <OpenImageIO/color.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/oiioversion.h>
#include <OpenImageIO/parallel.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <OpenImageIO/thread.h>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#if OIIO_VERSION < 20400
#error "tonetool needs OpenImageIO 2.4 or newer"
#endif

namespace tonetool::oiio {

/// Whether ociodisplay heeds looks.
inline constexpr bool kDisplayTakesLooks = OIIO_VERSION >= 20500;

/// Whether an image only knows its file so far: its header is read, its pixels are not.
inline bool is_unread_file(const OIIO::ImageBuf& image) {
    if (image.storage() == OIIO::ImageBuf::IMAGECACHE)
        return true;
#if OIIO_VERSION >= 30000
    return image.initialized() && !image.deep() && !image.name().empty() && !image.pixels_valid();
#else
    return false;
#endif
}

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

/// A reader of a file, with its rows in the file's order, or nullptr.
inline std::unique_ptr<OIIO::ImageInput> open_input(const std::string& file) {
    const OIIO::ImageSpec configuration;
    return OIIO::ImageInput::open(file, &configuration);
}

/// Whether a reader gives integers of light that alpha is in, so that they are decoded as they are.
/// `file` is the header of a file of that format.
inline bool encodes_with_alpha([[maybe_unused]] const OIIO::ImageSpec& file,
                               [[maybe_unused]] const std::string& format) {
#if OIIO_VERSION >= 20514
    int light = 1; // where the version leaves no choice
    (void)OIIO::getattribute("png:linear_premult", light);
    const std::string space = file.get_string_attribute("oiio:ColorSpace");
    return format == "png" && light != 0 &&
           (OIIO::Strutil::iequals(space, "sRGB") || space == "srgb_rec709_scene" ||
            file.get_float_attribute("oiio:Gamma", 1) != 1);
#else
    return false;
#endif
}

/// Whether a reader has multiplied encoded integers by alpha to the power of the file's gamma.
inline bool multiplies_by_power_of_alpha([[maybe_unused]] const OIIO::ImageSpec& file) {
#if OIIO_VERSION >= 20514
    return file.find_attribute("targa:version") != nullptr;
#else
    return true;
#endif
}

/// Whether the reader of OpenEXR files tells that the end of one is missing. (OpenEXR 3.4, which
/// may be below 3.x, fills what is not compressed.)
inline constexpr bool kTellsOfCutExr = OIIO_VERSION < 30000;

/// Whether PNM files hold 16 bits and floats where these are asked for.
inline constexpr bool kPnmTakesTypes = OIIO_VERSION >= 20500;

/// Asks the writer of PNM files for rows in the order that the format has.
inline void order_pnm_rows(OIIO::ImageSpec& spec) {
    spec.attribute("pnm:pfmflip", int(spec.format.is_floating_point()));
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

/// ImageBufAlgo::resize with the filter's own width.
inline bool resize(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src, const std::string& filter,
                   OIIO::ROI roi, int nthreads = 0) {
#if OIIO_VERSION >= 30000
    return OIIO::ImageBufAlgo::resize(dst, src, {{"filtername", filter}}, roi, nthreads);
#else
    return OIIO::ImageBufAlgo::resize(dst, src, filter, 0.0f, roi, nthreads);
#endif
}

/// Whether two names of a configuration mean one space, as far as the version knows.
inline bool same_space([[maybe_unused]] const OIIO::ColorConfig& config, const std::string& one,
                       const std::string& other) {
#if OIIO_VERSION >= 20500
    if (config.equivalent(one, other))
        return true;
#endif
    return OIIO::Strutil::iequals(one, other);
}

/// The space that the name of a file tells by the rules of a configuration; empty: none does.
inline std::string space_of_file(const OIIO::ColorConfig& config, const std::string& filename) {
    const std::string space(config.getColorSpaceFromFilepath(filename));
    return space == "unknown" ? "" : space;
}

/// ImageBufAlgo::ociodisplay, forwards.
inline bool ociodisplay(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src, const std::string& display,
                        const std::string& view, const std::string& from, const std::string& looks,
                        bool unpremult, const std::string& key, const std::string& value,
                        OIIO::ColorConfig& config) {
#if OIIO_VERSION >= 20500
    return OIIO::ImageBufAlgo::ociodisplay(dst, src, display, view, from, looks, unpremult, false,
                                           key, value, &config);
#else
    return OIIO::ImageBufAlgo::ociodisplay(dst, src, display, view, from, looks, unpremult, key,
                                           value, &config);
#endif
}

/// An image of a camera, or an image that holds an error.
inline OIIO::ImageBuf capture_image(int camera) {
#if OIIO_VERSION >= 30000
    OIIO::ImageBuf none;
    none.errorfmt("no image of camera {}: OpenImageIO {} does not read cameras", camera,
                  OIIO_VERSION_STRING);
    return none;
#else
    return OIIO::ImageBufAlgo::capture_image(camera);
#endif
}

/// ImageBufAlgo::fit with the filter's own width.
inline bool fit(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src, const std::string& filter,
                const std::string& fillmode, bool exact, OIIO::ROI roi) {
#if OIIO_VERSION >= 30000
    return OIIO::ImageBufAlgo::fit(
        dst, src, {{"filtername", filter}, {"fillmode", fillmode}, {"exact", int(exact)}}, roi);
#else
    return OIIO::ImageBufAlgo::fit(dst, src, filter, 0.0f, fillmode, exact, roi);
#endif
}

/// Threads that OpenEXR decodes with.
inline int exr_threads() {
    int threads = 0;
    OIIO::getattribute("exr_threads", threads);
    return threads > 0 ? threads : int(OIIO::Sysutil::hardware_concurrency());
}

/// Threads that 0 or a number of them stands for.
inline int threads_of(int nthreads) {
    return nthreads > 0 ? nthreads : OIIO::default_thread_pool()->size() + 1;
}

/// Runs work() `workers` times at once, on this thread and those of the pool.
inline void on_pool(int64_t workers, const std::function<void()>& work) {
    // As many chunks as threads, see above.
    OIIO::parallel_for_chunked(
        0, workers, 1, [&work](int64_t, int64_t) { work(); },
        OIIO::paropt(int(std::max<int64_t>(workers, 1))));
}

} // namespace tonetool::oiio
