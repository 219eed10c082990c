// SPDX-License-Identifier: BSD-3-Clause
// What a dailies check must know of a picture.
#include "tonetool/qc.h"

#include "python/families.h"
#include "python/results.h"

namespace tonetool::python {

namespace {

struct FactsOptions : QcOptions {
    int nthreads = 0;
};

py::object facts_of(std::vector<py::object>& images, const FactsOptions& options) {
    const InputImage image(images[0], "qc_facts: image");
    QcFacts facts;
    run_or_raise("qc_facts", [&](std::string& error) {
        return ToneAlgo::qc_facts(facts, {&image.buf()}, error, options, options.nthreads);
    });
    return py::cast(facts);
}

void add_counts(Module& module) {
    using S = QcSpot;
    ResultClass<S>(module, "QcSpot", "A pixel, and what it has.")
        .field("x", &S::x, "Column.")
        .field("y", &S::y, "Row.")
        .field("value", &S::value, "Of what is counted where it is finite, else 0.")
        .field("around", &S::around, "Of a spike: the largest value 3 pixels away.")
        .finish();
    using C = QcCount;
    ResultClass<C>(module, "QcCount", "How many pixels have something.")
        .field("pixels", &C::pixels, "Their number.")
        .field("first", &C::first, "The first of them by row, then column; at most 4.")
        .finish();
}

void add_layers(Module& module) {
    using L = QcLayer;
    ResultClass<L>(module, "QcLayer", "The values of a layer.")
        .field("name", &L::name, "\"\" for the plain R, G, B.")
        .field("kind", &L::kind,
               "\"picture\", \"light\", \"color\", \"albedo\", \"depth\", \"position\", "
               "\"normal\", \"motion\", \"id\" or \"data\".")
        .field("hash", &L::hash,
               "Of the values of a depth, position or id without filter, else \"\".")
        .field("constant", &L::constant, "Each channel but alpha has one value.")
        .field("lit", &L::lit, "Pixels that are finite and not 0.")
        .field("min", &L::min, "Smallest value.")
        .field("max", &L::max, "Largest value.")
        .field("mean", &L::mean, "Of the luminance of a colour, else of all values.")
        .field("nan", &L::nan, "Pixels with NaN.")
        .field("inf", &L::inf, "Pixels with infinity.")
        .field("negative", &L::negative, "Pixels with a negative value.")
        .finish();
    using P = QcPart;
    ResultClass<P>(module, "QcPart", "The header of a part of the file.")
        .field("name", &P::name, "Its name.")
        .field("data", &P::data, "Data window: x, y, width, height.")
        .field("display", &P::display, "Display window: x, y, width, height.")
        .field("compression", &P::compression, "As the header says it.")
        .field("metadata", &P::metadata, "All the rest; long values by their hash.")
        .finish();
}

void add_guides(Module& module) {
    using G = QcGuide;
    ResultClass<G>(module, "QcGuide", "A layer without noise in 32 x 18 cells.")
        .field("layer", &G::layer, "Its name.")
        .field("channels", &G::channels, "How many it has.")
        .field("cells", &G::cells,
               "Means of each channel of each cell x, as sign(x) log2(1 + 1000 |x|) in 1/1000.")
        .finish();
    using O = QcObject;
    ResultClass<O>(module, "QcObject", "An object of a layer of IDs.")
        .field("id", &O::id, "The bits of its ID.")
        .field("pixels", &O::pixels, "How many pixels show it.")
        .finish();
    using S = QcObjects;
    ResultClass<S>(module, "QcObjects", "Which objects a layer of IDs has.")
        .field("layer", &S::layer, "Its name; empty if there is none.")
        .field("inside", &S::inside,
               "The largest that are away from the left and the right border, at most 32.")
        .field("known", &S::known, "Two of 4096 bits for each ID that there is.")
        .finish();
}

void add_places(Module& module) {
    using R = QcRectangle;
    ResultClass<R>(module, "QcRectangle", "Pixels of the picture that have one exact colour.")
        .field("x", &R::x, "First column.")
        .field("y", &R::y, "First row.")
        .field("width", &R::width, "Columns.")
        .field("height", &R::height, "Rows.")
        .field("color", &R::color, "Its red, green and blue, as in the file.")
        .field("background", &R::background, "Nothing is behind 90 % of it.")
        .finish();
    using B = QcBorders;
    ResultClass<B>(module, "QcBorders",
                   "Per cent of a border's pixels that equal the pixel inside, in 32 parts.")
        .field("left", &B::left, "From the top.")
        .field("right", &B::right, "From the top.")
        .field("top", &B::top, "From the left.")
        .field("bottom", &B::bottom, "From the left.")
        .finish();
}

void add_picture(Module& module) {
    using P = QcPicture;
    ResultClass<P> picture(module, "QcPicture", "The colour that a viewer looks at.");
    visit_source<P>(visitor(picture));
    picture.field("objects", &P::objects, "Of the first layer of IDs.")
        .field("thumbnail", &P::thumbnail,
               "Mean luminance of 32 x 18 cells of the display window, in 1/1000 stop.")
        .field("red", &P::red, "Red over green of the same cells, in 1/32 stop.")
        .field("blue", &P::blue, "Blue over green of the same cells, in 1/32 stop.")
        .field("peaks", &P::peaks, "Largest component of 64 x 36 cells, in 1/8 stop.")
        .field("fingerprints", &P::fingerprints,
               "16 bits that tell 4 x 4 pixels in the middle of each of these; 0: of one colour.")
        .field("hash", &P::hash, "Of the values of its pixels.")
        .field("alpha_low", &P::alpha_low, "Alpha below 0, or NaN.")
        .field("alpha_high", &P::alpha_high, "Alpha above 1.")
        .field("spike_count", &P::spike_count, "Pixels 8 times as large as all 3 pixels away.")
        .field("spikes", &P::spikes, "The largest of them, at most 64.")
        .field("rectangles", &P::rectangles,
               "The largest of one exact colour, at least 8 x 8 pixels; at most 16.")
        .field("borders", &P::borders, "How plain the picture is at its borders.")
        .field("alpha_mean", &P::alpha_mean, "Of its alpha; 0 without one.")
        .field("alpha_clear", &P::alpha_clear, "Share of pixels whose alpha is 0; 0 without one.")
        .field("pairs", &P::pairs,
               "Shares of pixels that equal their right neighbour, in even and in odd columns.")
        .field("greens", &P::greens, "Pixels whose green is above 0.01 and below 1.")
        .field("distinct", &P::distinct, "Different values of these, at most 1000.")
        .field("fine", &P::fine,
               "Median distance of lit pixels from the mean of their four neighbours, in stops.")
        .field("coarse", &P::coarse, "The same of means of 2 x 2 pixels.")
        .field("across", &P::across, "Median distance from the pixel to the left, in stops.")
        .field("down", &P::down, "Median distance from the pixel above, in stops.")
        .field("at_one", &P::at_one, "Pixels with all channels lit, one exactly 1 and another not.")
        .field("beside_one", &P::beside_one,
               "Pixels with a channel at one of the half floats beside 1.")
        .field("at_largest_half", &P::at_largest_half, "Pixels with a channel at 65504.")
        .field("magenta", &P::magenta, "Share of an albedo that is magenta.")
        .field("speed", &P::speed, "95th percentile of the absolute values of a motion layer.")
        .field("groups", &P::groups, "Number of light groups.")
        .field("group_sum", &P::group_sum, "Light of all groups over that of the picture.")
        .field("group_difference", &P::group_difference,
               "Sum of the pixels' differences, over the same.")
        .field("group_worst", &P::group_worst, "The pixel that is off most.")
        .finish();
    using F = QcFacts;
    ResultClass<F>(module, "QcFacts", "Facts of a picture's header and pixels.")
        .field("parts", &F::parts, "One each.")
        .field("channels", &F::channels, "Data type by name, as in the file.")
        .field("layers", &F::layers, "One each.")
        .field("guides", &F::guides, "Layers without noise, which tell what moves: at most two.")
        .field("picture", &F::picture, "What a viewer looks at.")
        .finish();
}

} // namespace

void add_qc(Module& module) {
    add_counts(module);
    add_layers(module);
    add_guides(module);
    add_places(module);
    add_picture(module);
    define(module,
           Description{"qc_facts",
                       "Measure what a check of dailies must know of a picture and its layers.",
                       {image_parameter("image", "One part (subimage) with all its layers.")},
                       "QcFacts",
                       "The facts.",
                       "Shapes: height x width x channels, R, G, B first, or an ImageBuf. Units: "
                       "those of the image; luminance in linear Rec.709.\nNaN, Inf, negative, "
                       "alpha out of range: counted, with the first positions.",
                       "No picture among the layers, deep images, an unreadable file.",
                       "The checks of chain(\"--qc\"), which judge these facts over a shot."},
           Fields<FactsOptions>{
               field<FactsOptions>("pixels", &FactsOptions::pixels, "Layer and colour space."),
               field<FactsOptions>("groups", &FactsOptions::groups,
                                   "Light groups that are to add up to the picture, by "
                                   "name or layer; []: found by name."),
               threads_field<FactsOptions>()},
           facts_of);
}

} // namespace tonetool::python
