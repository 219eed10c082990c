// SPDX-License-Identifier: BSD-3-Clause
// TMQI.
#include "tonetool/tmqi.h"

#include "python/compare.h"
#include "python/families.h"

namespace tonetool::python {

namespace {

const std::string kTmqiSource =
    "H. Yeganeh, Z. Wang, \"Objective Quality Assessment of Tone-Mapped "
    "Images\", IEEE Transactions on Image Processing 22(2), 2013.";

struct TmqiCall : TmqiOptions {
    PixelOptions hdr_pixels, ldr_pixels;
    int nthreads = 0;
};
using TmqiObject = Imaged<TmqiSummary>;

Fields<TmqiCall> tmqi_fields() {
    using O = TmqiCall;
    return {
        field<O>("hdr_pixels", &O::hdr_pixels, "Layer and colour space of hdr."),
        field<O>("ldr_pixels", &O::ldr_pixels,
                 "Layer and colour space of ldr; an array that holds sRGB-encoded values needs "
                 "{\"from\": \"srgb\"}."),
        field<O>("crop", &O::crop, "Only where the display windows meet."),
        field<O>("memory", &O::memory, "Bytes as in hdr_flip; too few are an error. 0: no bound."),
        threads_field<O>()};
}

py::object run_tmqi(std::vector<py::object>& images, const TmqiCall& options) {
    const InputImage hdr(images[0], "tmqi: hdr"), ldr(images[1], "tmqi: ldr");
    TmqiOptions plain = options;
    plain.hdr = options.hdr_pixels;
    plain.ldr = options.ldr_pixels;
    TmqiSummary summary;
    OIIO::ImageBuf map = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::tmqi(dst, hdr.buf(), ldr.buf(), plain, &summary, options.nthreads);
    });
    return py::cast(TmqiObject{to_python(std::move(map), OutputKind::map(hdr)), summary});
}

py::object quantity_of_tmqi(std::vector<py::object>& arguments) {
    if (!py::isinstance<TmqiScore>(arguments[0]))
        wrong_type("tmqi_quantity: score", arguments[0], "a TmqiScore");
    const std::vector<std::string> names = ToneAlgo::tmqi_quantities();
    const size_t place = place_of(arguments[1], "tmqi_quantity: name", names);
    return Python<std::optional<double>>::to(
        ToneAlgo::tmqi_quantity(arguments[0].cast<const TmqiScore&>(), names[place]));
}

void add_tmqi_results(Module& module) {
    using S = TmqiScore;
    ResultClass<S> score(module, "TmqiScore",
                         "The tone-mapped image quality index, 0 to 1, and its parts.");
    score.field("q", &S::q, "0.8012 s^0.3046 + 0.1988 n^0.7088.")
        .field("s", &S::s, "Structural fidelity.")
        .field("n", &S::n, "Statistical naturalness.")
        .field("scales", &S::scales, "Fidelity at each of five scales, the finest first.");
    visit_shown_luminance(visitor(score));
    score.finish();
    using M = TmqiSummary;
    ResultClass<M>(module, "TmqiSummary", "What TMQI found, and in what.")
        .field("score", &M::score, "The index.")
        .field("hdr", &M::hdr, "How the HDR image was read.")
        .field("ldr", &M::ldr, "How the picture was read.")
        .field("region", &M::region, "Pixels compared.")
        .field("warnings", &M::warnings, "What a user must know, one sentence each.")
        .finish();
    ResultClass<TmqiObject>(module, "TmqiResult", "The map of structural fidelity and the index.")
        .object("map", &TmqiObject::image, "Image", "Structural fidelity at the finest scale.")
        .field("summary", &TmqiObject::summary, "The index and what it was made from.")
        .finish();
}

} // namespace

void add_tmqi(Module& module) {
    add_tmqi_results(module);
    define(
        module,
        Description{
            "tmqi",
            "How much of an HDR image a tone-mapped picture of it shows, and how natural it looks.",
            {image_parameter("hdr", "The HDR image; needs R, G, B and 11x11 pixels."),
             image_parameter("ldr", "The picture, of the same size; linear values are clamped to "
                                    "0 to 1 and sRGB-encoded.")},
            "TmqiResult",
            "The map, 1 where the structure is kept, 0 where it is lost, -1 at the least; the "
            "index "
            "in summary.score.",
            "Shapes: as hdr_flip; the map is of one channel, height x width, an array if hdr is "
            "one.\nUnits: that of hdr does not matter, its range is scaled.\nAlpha: ignored.\n"
            "NaN, Inf: such a pixel is black, its structure 0 unless both images have it. Counted, "
            "and in summary.warnings.",
            "No R, G, B, images below 11x11 pixels, a constant HDR image, deep images, different "
            "windows, no finite pixel, an unreadable file.",
            kTmqiSource},
        tmqi_fields(), run_tmqi);
    define(module,
           Description{"tmqi_quantity",
                       "A figure of the index by the name the program has for it.",
                       {{"score", "TmqiScore", "Of a summary.", ""},
                        {"name", "str", "One of tmqi_quantities().", ""}},
                       "float",
                       "The figure.",
                       "Units: 0 to 1, higher is better.",
                       "Never.",
                       kTmqiSource},
           quantity_of_tmqi);
    define_names(module, "tmqi_quantities", "Names of the figures of tmqi_quantity().", kTmqiSource,
                 ToneAlgo::tmqi_quantities);
}

} // namespace tonetool::python
