#include "chain/first_part.h"

#include "chain/error.h"

namespace tonetool::chain {

void warn_of_other_parts(Session& session, const Call& call, const Image& image) {
    if (image.part_count() > 1) {
        session.warning(call.row().label(),
                        "only the first of " + std::to_string(image.part_count()) +
                            " subimages of " + image.name() + " is looked at (--subimage chooses)");
    }
}

namespace {

void check_header(const Image& image, const OIIO::ImageSpec& header, const PixelOptions& options) {
    ColorChoice choice;
    std::string why;
    if (!ToneAlgo::find_color(header, options, choice, why)) {
        throw CommandError("\"" + image.name() + "\": " + why);
    }
}

} // namespace

void check_color(Session& session, const Call& call, const Image& image,
                 const PixelOptions& options) {
    warn_of_other_parts(session, call, image);
    Part& part = image.part();
    OIIO::ImageSpec header = part.header();
    if (part.integer_encoded()) {
        header.format = part.format().value_or(DataFormat{OIIO::TypeUInt8, {}, 0}).type;
    }
    check_header(image, header, options);
}

OIIO::ImageBuf color_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options) {
    check_color(session, call, image, options);
    return image.part().color_view();
}

OIIO::ImageBuf color_source(Session& session, const Call& call, const Image& image,
                            const PixelOptions& options) {
    check_color(session, call, image, options);
    // A tag must be a known one also where the library would take an integer file's for sRGB.
    OIIO::ImageSpec header = image.part().header();
    if (header.find_attribute("oiio:ColorSpace")) {
        header.set_format(OIIO::TypeFloat);
        check_header(image, header, options);
    }
    return image.part().color_source();
}

const OIIO::ImageBuf& flat_pixels(const Image& image) {
    const OIIO::ImageBuf& pixels = image.part().pixels();
    if (pixels.deep()) {
        throw CommandError("\"" + image.name() + "\" is deep, which this command cannot use");
    }
    return pixels;
}

} // namespace tonetool::chain
