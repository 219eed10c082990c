// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/encoded.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <stdexcept>
#include <vector>

#include "sequence/results/base64.h"

namespace tonetool::sequence {

namespace {

using Bytes = std::vector<unsigned char>;

bool is_png(Encoding encoding) {
    return encoding == Encoding::Png || encoding == Encoding::PngBytes;
}

// The header is new: the attributes of the image's file do not belong into the page.
OIIO::ImageSpec spec_of(const OIIO::ImageBuf& picture, Encoding encoding, int quality) {
    const bool full_color = encoding == Encoding::JpegMap;
    const OIIO::ROI roi = picture.roi();
    OIIO::ImageSpec spec(roi.width(), roi.height(), 3, OIIO::TypeDesc::UINT8);
    if (encoding != Encoding::PngBytes)
        spec.attribute("oiio:ColorSpace", "sRGB");
    if (!is_png(encoding)) {
        spec.attribute("Compression", OIIO::Strutil::sprintf("jpeg:%d", quality));
        spec.attribute("jpeg:subsampling", full_color ? "4:4:4" : "4:2:0");
    } else {
        spec.attribute("png:compressionLevel", 6);
    }
    if (encoding == Encoding::PngBytes) {
        // Bytes of noise hardly ever repeat. To look for that takes seven times as long and finds
        // less than the difference to the neighbour does (PNG_FILTER_SUB).
        spec.attribute("compression", "rle");
        spec.attribute("png:filter", 0x10);
    }
    return spec;
}

// The first three channels; nothing where they are in memory as they are wanted.
Bytes copied(const OIIO::ImageBuf& picture) {
    OIIO::ROI roi = picture.roi();
    if (picture.localpixels() && picture.spec().format == OIIO::TypeDesc::UINT8 &&
        picture.contiguous() && picture.nchannels() == 3)
        return {};
    roi.chbegin = 0;
    roi.chend = 3;
    Bytes pixels(size_t(roi.npixels()) * 3);
    if (!picture.get_pixels(roi, OIIO::TypeDesc::UINT8, pixels.data()))
        throw std::runtime_error("could not encode a picture: " + picture.geterror());
    return pixels;
}

Bytes encoded(const OIIO::ImageBuf& picture, Encoding encoding, int quality) {
    const char* name = is_png(encoding) ? "picture.png" : "picture.jpg";
    const OIIO::ImageSpec spec = spec_of(picture, encoding, quality);
    const Bytes copy = copied(picture);
    const void* pixels = copy.empty() ? picture.localpixels() : copy.data();
    Bytes bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create(name);
    if (!output)
        throw std::runtime_error(OIIO::geterror());
    const bool done = output->set_ioproxy(&memory) && output->open(name, spec) &&
                      output->write_image(OIIO::TypeDesc::UINT8, pixels) && output->close();
    if (!done || bytes.empty())
        throw std::runtime_error("could not encode a picture: " + output->geterror());
    return bytes;
}

} // namespace

std::string data_uri(const OIIO::ImageBuf& picture, Encoding encoding, int quality) {
    const Bytes bytes = encoded(picture, encoding, quality);
    const char* type = is_png(encoding) ? "png" : "jpeg";
    return std::string("data:image/") + type + ";base64," + base64(bytes);
}

std::optional<OIIO::ImageBuf> picture_of(const std::string& data_uri) {
    const size_t comma = data_uri.find(";base64,");
    if (comma == std::string::npos)
        return std::nullopt;
    Bytes bytes = bytes_of_base64(data_uri, comma + 8);
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const bool png = data_uri.rfind("data:image/png", 0) == 0;
    auto input = OIIO::ImageInput::open(png ? "picture.png" : "picture.jpg", nullptr, &memory);
    if (!input)
        return std::nullopt;
    const OIIO::ImageSpec& found = input->spec();
    OIIO::ImageBuf picture(OIIO::ImageSpec(found.width, found.height, 3, OIIO::TypeDesc::UINT8));
    const bool done = found.nchannels == 3 &&
                      input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, picture.localpixels());
    return done ? std::optional<OIIO::ImageBuf>(std::move(picture)) : std::nullopt;
}

} // namespace tonetool::sequence
