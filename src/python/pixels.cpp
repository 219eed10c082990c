// SPDX-License-Identifier: BSD-3-Clause
// Which pixels of an image a function looks at.
#include "tonetool/pixels.h"

#include "tonetool/libraries.h"

#include "python/families.h"
#include "python/results.h"

namespace tonetool::python {

namespace {

const std::string kPixelsSource =
    "OpenEXR's and the renderers' names of layers and channels; colour "
    "spaces by ITU-R BT.709, BT.2020, SMPTE ST 2065-1, S-2014-004 (ACEScg), "
    "IEC 61966-2-1.";

struct ChannelOptions {
    std::vector<std::string> channels;
};

py::object find_color(std::vector<py::object>& images, const PixelOptions& options) {
    const InputImage image(images[0], "find_color: image");
    check_read(image.buf(), "find_color");
    ColorChoice choice;
    run_or_raise("find_color", [&](std::string& error) {
        return ToneAlgo::find_color(image.buf().spec(), options, choice, error);
    });
    return py::cast(choice);
}

// `from` is a word of Python.
Fields<PixelOptions> keywords() {
    Fields<PixelOptions> fields = table_of<PixelOptions>().fields;
    for (Field<PixelOptions>& row : fields)
        row.name += row.name == "from" ? "_" : "";
    return fields;
}

py::object color_layers(std::vector<py::object>& images) {
    const InputImage image(images[0], "color_layers: image");
    check_read(image.buf(), "color_layers");
    return Python<std::vector<std::string>>::to(ToneAlgo::color_layers(image.buf().spec()));
}

py::object image(std::vector<py::object>& images, const ChannelOptions& options) {
    const InputImage pixels(images[0], "image: pixels",
                            options.channels.empty() ? Channels::Plain : Channels::Named);
    if (!knows_imagebuf())
        throw py::import_error("image: makes an OpenImageIO.ImageBuf: " + why_no_imagebuf());
    return py::cast(named_image(pixels, options.channels, "image: channels"));
}

void add_choice(Module& module) {
    using S = ColorChoice;
    ResultClass<S>(module, "ColorChoice", "Where the colour of an image is.")
        .field("r", &S::r, "Index of the channel.")
        .field("g", &S::g, "Index of the channel.")
        .field("b", &S::b, "Index of the channel.")
        .field("a", &S::a, "Index of the layer's alpha, -1: none.")
        .field("layer", &S::layer, "\"\" for the plain R, G, B.")
        .field("space", &S::space, "Colour space the values are read in.")
        .field("display_encoded", &S::display_encoded,
               "Values are sRGB-encoded and are decoded on reading.")
        .finish();
}

} // namespace

void add_pixels(Module& module) {
    const Table<PixelOptions>& table = table_of<PixelOptions>();
    module.add_mapping(table);
    add_choice(module);
    const std::string notes = "Shapes, NaN: only the header of the image is looked at. Units: "
                              "channels are counted from 0.";
    define(module,
           Description{
               "find_color",
               "Choose the colour channels and the colour space of an image, as every function "
               "of this module does.",
               {image_parameter("image", "Any image.")},
               "ColorChoice",
               "What was chosen.",
               notes,
               "No colour, or two candidates for the beauty; the layers are listed. An image that "
               "cannot be read.",
               kPixelsSource},
           keywords(), find_color);
    define(module,
           Description{"color_layers",
                       "Names of all layers that have R, G and B.",
                       {image_parameter("image", "Any image.")},
                       "list[str]",
                       "Names; the plain R, G, B is \"R,G,B\".",
                       notes,
                       "An image that cannot be read.",
                       kPixelsSource},
           color_layers);
    define_names(
        module, "library_versions",
        "Versions of OpenImageIO, OpenColorIO and OpenEXR, and the instruction set in use.",
        kPixelsSource, library_versions);
    define_names(module, "color_spaces", "Names of the colour spaces that `from` takes.",
                 kPixelsSource, ToneAlgo::color_spaces);
    define(module,
           Description{
               "image",
               "A copy of pixels as an OpenImageIO.ImageBuf with names of channels, as guides "
               "(\"P.X\", \"N.X\", \"Z\", ...) and layers need them.",
               {image_parameter("pixels", "An array, or another image.")},
               "ImageBuf",
               "The image.",
               "Shapes: height x width x channels, or height x width for one channel; any number "
               "of channels where each has a name. Values, NaN among them, are kept; \"A\" is "
               "alpha.",
               "An image that cannot be read whole.",
               "OpenImageIO's ImageBuf."},
           Fields<ChannelOptions>{
               field<ChannelOptions>("channels", &ChannelOptions::channels,
                                     "A name for each channel; []: R, G, B, A or Y.")},
           image);
}

} // namespace tonetool::python
