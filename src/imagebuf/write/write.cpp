// SPDX-License-Identifier: BSD-3-Clause
// Files that are either the old one or the whole new one.
#include "tonetool/write.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cstring>
#include <deque>
#include <memory>

#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/has_pixels.h"
#include "imagebuf/pixels/row_source.h"
#include "imagebuf/pixels/rows_together.h"
#include "imagebuf/write/output_target.h"
#include "imagebuf/write/sure_file.h"
#include "imagebuf/write/write_checks.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

// An image may say of a failed read at any later moment.
void check_no_error(const OIIO::ImageBuf& image) {
    if (image.has_error())
        throw Refusal(with_name(image, image.geterror()));
}

// In pieces, so that a conversion does not take another image's memory.
bool write_pixels(const OIIO::ImageBuf& image, OIIO::ImageOutput& out) {
    constexpr int rows_at_once = 512; // whole blocks of every compression, enough for all threads
    const OIIO::ImageSpec& spec = image.spec();
    if (!image.localpixels() || spec.deep || spec.depth > 1 || out.spec().tile_width > 0)
        return image.write(&out);
    const int first = out.spec().y; // its own, where the format has no origin
    for (int row = 0; row < spec.height; row += rows_at_once) {
        const int end = std::min(row + rows_at_once, spec.height);
        if (!out.write_scanlines(first + row, first + end, out.spec().z, spec.format,
                                 image.pixeladdr(spec.x, spec.y + row), image.pixel_stride(),
                                 image.scanline_stride()))
            return false;
    }
    return true;
}

// Takes the writer, to destroy it before its proxy: that of EXR files leaves those of MIP levels
// open when they are closed, and writes where their tiles lie only then.
void write_through(std::unique_ptr<OIIO::ImageOutput> out, const std::vector<OutputImage>& images,
                   const std::string& filename) {
    std::vector<OIIO::ImageSpec> specs;
    for (const OutputImage& image : images)
        if (!image.mip_level)
            specs.push_back(image.spec);
    for (size_t i = 0; i < images.size(); ++i) {
        const OIIO::ImageBuf& image = *images[i].pixels;
        const bool on_disk = is_file_to_read(image);
        const OIIO::ImageBuf read =
            on_disk ? read_whole(image, image.spec().format) : OIIO::ImageBuf();
        const bool opened =
            i > 0 ? out->open(filename, images[i].spec,
                              images[i].mip_level ? OIIO::ImageOutput::AppendMIPLevel
                                                  : OIIO::ImageOutput::AppendSubimage)
                  : (specs.size() > 1 ? out->open(filename, int(specs.size()), specs.data())
                                      : out->open(filename, specs[0]));
        const bool written = opened && write_pixels(on_disk ? read : image, *out);
        check_no_error(image);
        if (!written)
            throw Refusal(out->geterror());
    }
    if (!out->close())
        throw Refusal(out->geterror());
}

size_t count_subimages(const std::vector<OutputImage>& images) {
    return size_t(std::count_if(images.begin(), images.end(),
                                [](const OutputImage& image) { return !image.mip_level; }));
}

// The WebP writer (OpenImageIO 2.4) frees memory that it never had when it refuses an image.
void check_takes(const OIIO::ImageOutput& out, const OIIO::ImageSpec& spec) {
    constexpr int most = 16383; // of the format
    const bool webp = std::strcmp(out.format_name(), "webp") == 0;
    if (webp && (spec.nchannels < 3 || spec.nchannels > 4))
        throw Refusal(format("webp files have 3 or 4 channels, the image has {}", spec.nchannels));
    if (webp && (spec.width > most || spec.height > most))
        throw Refusal(format("webp files have at most {} x {} pixels, the image has {} x {}", most,
                             most, spec.width, spec.height));
}

void check_images(const std::vector<OutputImage>& images, const OIIO::ImageOutput& out) {
    if (images.empty())
        throw Refusal("there is no image to write");
    for (const OutputImage& image : images)
        if (!image.pixels || !image.pixels->initialized() || image.pixels->has_error() ||
            !has_pixels(*image.pixels)) {
            const std::string none = "the image holds no pixels";
            if (image.pixels)
                check_no_error(*image.pixels);
            throw Refusal(image.pixels ? with_name(*image.pixels, none) : none);
        }
    for (const OutputImage& image : images)
        if (image.spec.roi() != image.pixels->roi() || image.spec.deep != image.pixels->spec().deep)
            throw Refusal("the spec to write does not have the image's size and channels");
    for (const OutputImage& image : images)
        check_takes(out, image.spec);
    if (count_subimages(images) > 1 && !out.supports("multiimage"))
        throw Refusal(
            format("{} files hold one image, there are {}", out.format_name(), images.size()));
}

// Rows that are read back at once.
constexpr int kRowsBack = 256;

bool read_back_rows(OIIO::ImageInput& in, int subimage, int level, const OIIO::ImageSpec& spec) {
    std::vector<unsigned char> pixels;
    if (spec.depth > 1) {
        pixels.resize(spec.image_bytes(true));
        return in.read_image(subimage, level, 0, -1, OIIO::TypeUnknown, pixels.data());
    }
    const bool tiled = spec.tile_width > 0;
    const int step = whole_rows(kRowsBack, spec, in.format_name());
    for (int y = spec.y; y < spec.y + spec.height; y += step) {
        const int end = std::min(y + step, spec.y + spec.height);
        pixels.resize(size_t(end - y) * spec.scanline_bytes(true));
        const bool read =
            tiled ? in.read_tiles(subimage, level, spec.x, spec.x + spec.width, y, end, 0, 1, 0,
                                  spec.nchannels, OIIO::TypeUnknown, pixels.data())
                  : in.read_scanlines(subimage, level, y, end, 0, 0, spec.nchannels,
                                      OIIO::TypeUnknown, pixels.data());
        if (!read)
            return false;
    }
    return true;
}

bool read_back_levels(OIIO::ImageInput& in, int subimage) {
    for (int level = 0;; ++level) {
        // Not by in.spec(): that of TIFF files has the first level's for all that are not there.
        if (!in.seek_subimage(subimage, level)) {
            (void)in.geterror();
            return level > 0;
        }
        const OIIO::ImageSpec spec = in.spec();
        OIIO::DeepData deep;
        if (!(spec.deep ? in.read_native_deep_image(subimage, level, deep)
                        : read_back_rows(in, subimage, level, spec)))
            return false;
    }
}

// OpenImageIO (2.4) fills the place of a description that an SGI file does not have with whatever
// lies in memory.
bool lacks_description(const OIIO::ImageOutput& out, const OIIO::ImageSpec& spec) {
    return std::strcmp(out.format_name(), "sgi") == 0 &&
           spec.get_string_attribute("ImageDescription").empty();
}

void clear_description(CheckedProxy& proxy) {
    constexpr int64_t place = 24; // of the format
    constexpr char none[80] = {};
    proxy.pwrite(none, sizeof none, place);
}

// Whether its writer does not come back from a failed write, see SureFile.
bool needs_sure_file(const OIIO::ImageOutput& out, const std::vector<OutputImage>& images) {
    return std::strcmp(out.format_name(), "openexr") == 0 && count_subimages(images) > 1 &&
           std::any_of(images.begin(), images.end(),
                       [](const OutputImage& image) { return image.spec.tile_width > 0; });
}

// Of pixels, and of what lies around them. Tiles at the edges are whole.
int64_t most_bytes(const std::vector<OutputImage>& images) {
    double bytes = 1 << 20;
    for (const OutputImage& image : images) {
        const OIIO::ImageSpec& spec = image.spec;
        bytes += 1.1 * double(spec.pixel_bytes(true)) * (spec.width + spec.tile_width) *
                 (spec.height + spec.tile_height);
    }
    return int64_t(bytes);
}

bool says_how_it_is_turned(const OIIO::ImageOutput& out) {
    static const std::vector<std::string> formats = {"openexr", "tiff", "jpeg",
                                                     "dpx",     "fits", "null"};
    return std::find(formats.begin(), formats.end(), out.format_name()) != formats.end();
}

// Images whose Orientation their format cannot say are turned as it says. `turned` holds what the
// images then point to.
void turn_upright(std::vector<OutputImage>& images, std::deque<OIIO::ImageBuf>& turned) {
    for (OutputImage& image : images) {
        OIIO::ImageSpec& spec = image.spec;
        if (!image.upright || spec.deep || spec.depth > 1 ||
            spec.get_int_attribute("Orientation", 1) == 1)
            continue;
        OIIO::ImageBuf whole;
        const bool on_disk = is_file_to_read(*image.pixels);
        if (on_disk)
            whole = read_whole(*image.pixels, image.pixels->spec().format);
        const int turn = spec.get_int_attribute("Orientation", 1);
        if (image.pixels->orientation() != turn) {
            if (!on_disk)
                whole = image.pixels->copy(OIIO::TypeUnknown);
            whole.specmod().attribute("Orientation", turn);
        }
        OIIO::ImageBuf upright =
            OIIO::ImageBufAlgo::reorient(whole.initialized() ? whole : *image.pixels);
        if (upright.has_error())
            throw Refusal(upright.geterror());
        turned.push_back(std::move(upright));
        image.pixels = &turned.back();
        const OIIO::ImageSpec& now = turned.back().spec();
        spec.x = now.x;
        spec.y = now.y;
        spec.width = now.width;
        spec.height = now.height;
        spec.set_roi_full(now.roi_full());
        spec.attribute("Orientation", 1);
    }
}

void write_checked(std::vector<OutputImage> images, const std::string& filename) {
    const std::string kind = images.empty() ? "" : images.front().format_name;
    auto out = OIIO::ImageOutput::create(kind.empty() ? filename : kind);
    if (!out)
        throw Refusal(OIIO::geterror());
    check_images(images, *out);
    std::deque<OIIO::ImageBuf> turned;
    if (!says_how_it_is_turned(*out))
        turn_upright(images, turned);
    OutputTarget target(filename);
    target.open();
    CheckedProxy proxy(target);
    if (takes_proxy(*out))
        out->set_ioproxy(&proxy);
    else if (target.is_device())
        throw Refusal(format("{} files cannot be written to a device or pipe", out->format_name()));
    const bool undescribed = lacks_description(*out, images.front().spec);
    SureFile sure;
    const bool surely = needs_sure_file(*out, images);
    if (surely)
        sure.open(target, most_bytes(images));
    const auto said_of_target = [&](const std::string& why) {
        const std::string said = proxy.failure().empty() ? why : proxy.failure();
        return target.in_its_name(surely ? target.in_its_name(said, sure.path()) : said);
    };
    refusing_as(said_of_target, [&] {
        write_through(std::move(out), images, surely ? sure.path() : target.path());
        sure.copy_to(proxy);
        proxy.check();
        // Writers without a proxy, and those that pass it over (several subimages, deep pixels),
        // have opened the file by its name.
        if (proxy.size() == 0)
            check_reads_back(target.path(), count_subimages(images));
    });
    if (undescribed)
        clear_description(proxy);
    proxy.check();
    target.commit();
}

template <class Put>
void write_pieces(const Put& put, const std::string& filename, Links links) {
    OutputTarget target(filename, links);
    target.open();
    CheckedProxy proxy(target);
    put([&](const std::string& piece) { proxy.write(piece.data(), piece.size()); });
    proxy.check();
    target.commit();
}

// Runs a write; an error names the file.
template <class Run>
bool named(const std::string& filename, std::string& error, const Run& run) {
    if (contained(error, run))
        return true;
    const std::string name = valid_utf8(filename);
    if (error.find(name) == std::string::npos)
        error = format("could not write \"{}\": {}", name, error);
    return false;
}

} // namespace

bool takes_proxy(const OIIO::ImageOutput& out) {
    // TIFF files with Exif data come out corrupt through a proxy (OpenImageIO 2.4, libtiff 4.5).
    return out.supports("ioproxy") && std::strcmp(out.format_name(), "tiff") != 0;
}

void check_reads_back(const std::string& path, size_t subimages) {
    const auto in = OIIO::ImageInput::open(path);
    for (int s = 0; in && s < int(subimages) && read_back_levels(*in, s); ++s)
        if (s + 1 == int(subimages))
            return;
    throw Refusal("the file that was written cannot be read back: " +
                  (in ? in->geterror() : OIIO::geterror()));
}

bool write_images(const std::vector<OutputImage>& images, const std::string& filename,
                  std::string& error) {
    return named(filename, error, [&] { write_checked(images, filename); });
}

bool write_image(const OIIO::ImageBuf& image, const std::string& filename, std::string& error) {
    return write_images({{&image, image.spec()}}, filename, error);
}

bool write_bytes(const std::string& bytes, const std::string& filename, std::string& error,
                 Links links) {
    return named(filename, error,
                 [&] { write_pieces([&](const auto& take) { take(bytes); }, filename, links); });
}

bool write_bytes(
    const std::function<void(const std::function<void(const std::string& piece)>&)>& put,
    const std::string& filename, std::string& error) {
    return named(filename, error, [&] { write_pieces(put, filename, Links::Follow); });
}

} // namespace tonetool
