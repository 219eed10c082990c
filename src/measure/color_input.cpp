#include "measure/color_input.h"

#include "text/error.h"

namespace tonetool::measure {

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
    session.warn_of_other_parts(call.row().label(), image);
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

} // namespace tonetool::measure
