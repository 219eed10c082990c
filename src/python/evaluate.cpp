// SPDX-License-Identifier: BSD-3-Clause
// FLIP called as the package flip-evaluator is called.
#include <OpenImageIO/strutil.h>
#include <cmath>
#include <utility>

#include "python/evaluated.h"
#include "python/families.h"
#include "tonetool/display.h"
#include "tonetool/flip.h"

namespace tonetool::python {

namespace {

// The keys of `parameters`.
struct Asked : HdrFlipOptions {
    std::optional<std::vector<double>> vc;
    std::optional<std::string> tonemapper;
};

Fields<Asked> ldr_keys() {
    return {field<Asked>("ppd", &Asked::ppd, "Pixels per degree."),
            field<Asked>("vc", &Asked::vc, "Distance, width, pixels of the screen.")};
}

Fields<Asked> hdr_keys() {
    return joined<Asked>(
        {ldr_keys(),
         {field<Asked>("tonemapper", &Asked::tonemapper, "One of flip_tonemappers()."),
          field<Asked>("startExposure", &Asked::start_exposure, "Stops."),
          field<Asked>("stopExposure", &Asked::stop_exposure, "Stops."),
          field<Asked>("numExposures", &Asked::num_exposures, "How many.")}});
}

void take_viewing(Asked& asked) {
    const std::vector<double>& vc = *asked.vc;
    if (vc.size() != 3)
        throw py::value_error("evaluate: parameters: vc has " + std::to_string(vc.size()) +
                              " numbers: must be three, the distance and the width of the screen "
                              "in metres and its width in pixels");
    asked.distance = vc[0];
    asked.width = vc[1];
    asked.pixels_across = vc[2];
    constexpr double degree = 3.14159265358979323846 / 180;
    const double ppd = vc[0] * (vc[2] / vc[1]) * degree;
    if (asked.ppd && !(std::abs(*asked.ppd - ppd) <= 1e-4 * ppd))
        throw py::value_error("evaluate: parameters: ppd and vc say different things: give one");
}

Asked asked_for(const py::object& parameters, bool hdr) {
    const std::string where = "evaluate: parameters";
    const Fields<Asked> keys = hdr ? hdr_keys() : ldr_keys();
    std::vector<std::string> names;
    for (const Field<Asked>& key : keys)
        names.push_back(key.name);
    Asked asked;
    for (const auto& [name, value] : to_pairs(parameters, where, "Mapping[str, object]")) {
        place_of(to_str(name), where + (hdr ? "" : " of \"LDR\""), names);
        set_field(asked, keys, where, name, value);
    }
    if (asked.vc)
        take_viewing(asked);
    if (asked.tonemapper)
        asked.curve.name = *asked.tonemapper;
    return asked;
}

// What was used, in a form that can be given again.
py::dict used(const FlipSummary& summary, const Asked& asked) {
    py::dict parameters;
    parameters["ppd"] = summary.ppd;
    if (asked.vc)
        parameters["vc"] = list_of(*asked.vc);
    if (summary.hdr) {
        parameters["tonemapper"] = to_str(summary.tonemapper);
        parameters["startExposure"] = summary.exposures.front();
        parameters["stopExposure"] = summary.exposures.back();
        parameters["numExposures"] = summary.exposures.size();
    }
    return parameters;
}

py::object shown(OIIO::ImageBuf&& map, bool magma, int nthreads) {
    if (magma)
        map = computed([&](OIIO::ImageBuf& dst) {
            return ToneAlgo::color_map(dst, map, "magma", 0, {}, nthreads);
        });
    return to_python(std::move(map), {true, true});
}

struct Threads {
    int nthreads = 0;
};

py::object evaluate(std::vector<py::object>& given, const Threads& threads) {
    const bool hdr = place_of(given[2], "evaluate: dynamicRangeString", {"LDR", "HDR"}) == 1;
    const bool srgb = to_bool(given[3], "evaluate: inputsRGB");
    const bool magma = to_bool(given[4], "evaluate: applyMagma");
    const bool mean = to_bool(given[5], "evaluate: computeMeanError");
    const Asked asked = asked_for(given[6], hdr);
    const Encoding encoding = hdr ? Encoding::Scene : srgb ? Encoding::Srgb : Encoding::Linear;
    const EvaluatedImage reference(given[0], "evaluate: reference", encoding);
    const EvaluatedImage test(given[1], "evaluate: test", encoding);
    FlipResult result;
    OIIO::ImageBuf map = computed([&](OIIO::ImageBuf& dst) {
        return hdr ? ToneAlgo::hdr_flip(dst, reference.buf(), test.buf(), asked, &result, {},
                                        threads.nthreads)
                   : ToneAlgo::ldr_flip(dst, reference.buf(), test.buf(), asked, &result, {},
                                        threads.nthreads);
    });
    for (const EvaluatedImage* image : {&reference, &test})
        if (!image->warning().empty())
            warn(image->warning());
    for (const std::string& warning : result.summary.warnings)
        warn("evaluate: " + warning);
    for (const auto& [name, side] : {std::pair("reference", &result.summary.reference),
                                     std::pair("test", &result.summary.test)})
        if (side->negative > 0)
            warn(
                OIIO::Strutil::fmt::format("evaluate: {} has {} pixels with negative values, which "
                                           "count as 0",
                                           name, side->negative));
    return py::make_tuple(shown(std::move(map), magma, threads.nthreads),
                          mean ? result.summary.pool.mean : -1.0, used(result.summary, asked));
}

const char kEvaluateNotes[] =
    "The call of the package flip-evaluator, with hdr_flip() and ldr_flip() behind it: the same "
    "numbers, to the bit. Those two say more.\n"
    "Shapes: arrays of height x width x channels (R, G, B first; grey: height x width); the map "
    "is an array whatever the images are. Files and ImageBufs may have any layers and names of "
    "channels: the picture of them is compared. Alpha: ignored.\n"
    "Units, colour, of an array in \"HDR\": floats, scene light in linear Rec.709; inputsRGB has "
    "no say. In \"LDR\": floats of 0 to 1, or uint8 (0 to 255) or uint16 (0 to 65535), "
    "sRGB-encoded; with inputsRGB=False linear Rec.709.\n"
    "Of a file or an ImageBuf: its header says, else integers are sRGB-encoded and floats are "
    "linear Rec.709. inputsRGB=False makes integers linear, whatever the header says; it does not "
    "change floats, nor does True.\n"
    "Errors: integers in \"HDR\"; an array with values more than 1e-5 outside 0 to 1 in \"LDR\" "
    "(numpy.clip(array, 0, 1) if that is meant); different sizes; signed integers, bool and other "
    "types; no finite pixel; a key of `parameters` that is not known or not of that range.\n"
    "A UserWarning: NaN, Inf (such a pixel has error 1, or 0 where both images have the same), "
    "negative "
    "light, a file of floats beyond 0 to 1 in \"LDR\" (clamped), and all else that "
    "summary.warnings of hdr_flip() has.\n"
    "What differs from that package: paths may be os.PathLike, ImageBufs, float16, float64, uint8, "
    "uint16, grey and alpha are taken; tonemapper may be any of flip_tonemappers(); unknown "
    "parameters, wrong ranges and sizes are errors; the magma colours are interpolated, not those "
    "of the nearest of 256 entries; what was not asked of `parameters` is in the dict that is "
    "returned, as it was used.";

} // namespace

void add_evaluate(Module& module) {
    const char* image = "Image | str | os.PathLike[str]";
    define(
        module,
        Description{
            "evaluate",
            "FLIP of two images, called as the package flip-evaluator is: map, mean, parameters.",
            {{"reference", image, "A file, an array or an ImageBuf.", ""},
             {"test", image, "The same, in any mix.", ""},
             {"dynamicRangeString", "Literal[\"HDR\", \"LDR\"]",
              "HDR-FLIP of scene light, or LDR-FLIP of pictures for a screen.", ""},
             {"inputsRGB", "bool", "Of \"LDR\": arrays are sRGB-encoded, not linear.", "True"},
             {"applyMagma", "bool", "The map in colours, sRGB-encoded, not the error.", "True"},
             {"computeMeanError", "bool", "Else the mean is -1.", "True"},
             {"parameters", "Mapping[str, object]",
              "ppd: pixels per degree; or vc: [distance, width of the screen in metres, its "
              "width in pixels], by default 0.7, 0.7, 3840. Of \"HDR\" also tonemapper "
              "(\"aces\"), startExposure and stopExposure (stops) and numExposures, which by "
              "default follow from the reference.",
              "{}"}},
            "tuple[NDArray[np.float32], float, dict[str, object]]",
            "The map, height x width x 3 in colours, else height x width x 1; its mean; the "
            "parameters as they were used: ppd, vc where it was given, of \"HDR\" tonemapper, "
            "startExposure, stopExposure, numExposures.",
            kEvaluateNotes,
            "What hdr_flip and ldr_flip refuse.",
            "P. Andersson et al., \"FLIP: A Difference Evaluator for Alternating Images\", HPG "
            "2020; \"Visualizing Errors in Rendered High Dynamic Range Images\", Eurographics "
            "2021."},
        Fields<Threads>{threads_field<Threads>()}, evaluate);
}

} // namespace tonetool::python
