// SPDX-License-Identifier: BSD-3-Clause
// LDR-FLIP, HDR-FLIP and the filmstrip.
#include "tonetool/flip.h"

#include "imagebuf/options/flip_options.h"
#include "python/families.h"
#include "python/flip_results.h"

namespace tonetool::python {

namespace {

template <class O>
Fields<O> flip_fields() {
    return joined<O>({pair_fields<O>(), described<O, FlipOptions>()});
}

template <class O>
Fields<O> hdr_fields() {
    return joined<O>(
        {flip_fields<O>(),
         {field<O>("curve", &O::curve, "Tone curve; None: aces as in the paper."),
          field<O>("view", &O::view,
                   "A view of an OpenColorIO configuration instead of the curve.")},
         described<O, HdrFlipOptions>(),
         {field<O>("want_exposure_map", &O::want_exposure_map,
                   "Fill exposure_stops and exposure_index of the result."),
          field<O>("want_exposures", &O::want_exposures, "Fill exposures of the result.")}});
}

const std::string kSourceLdr =
    "P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild, "
    "\"FLIP: A Difference Evaluator for Alternating Images\", HPG 2020.";
const std::string kSourceHdr =
    "P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Moller, \"Visualizing Errors in Rendered "
    "High Dynamic Range Images\", Eurographics 2021; " +
    kSourceLdr;
const std::string kMapNotes =
    "Units of the map: FLIP's error, 0 (no visible difference) to 1.\n"
    "NaN, Inf: a pixel that has them in one image has error 1, as has one that has other ones in "
    "both; alike in both: 0. Neighbours see the other "
    "image's pixel. Counted, and in summary.warnings.";
const std::string kPairErrors =
    "No R, G, B, two candidates for the beauty, deep images, different display windows, a value "
    "out of range, an unreadable file, no finite pixel, a bound of memory that is too small.";

py::object ldr(std::vector<py::object>& images, const On<FlipOptions>& options) {
    const InputImage reference(images[0], "ldr_flip: reference"), test(images[1], "ldr_flip: test");
    FlipResult result;
    OIIO::ImageBuf map = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::ldr_flip(dst, reference.buf(), test.buf(), options, &result, options.roi,
                                  options.nthreads);
    });
    return flip_object(std::move(map), std::move(result), reference);
}

py::object hdr_one(const InputImage& reference, const InputImage& test,
                   const On<HdrFlipOptions>& options) {
    FlipResult result;
    OIIO::ImageBuf map = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::hdr_flip(dst, reference.buf(), test.buf(), options, &result, options.roi,
                                  options.nthreads);
    });
    return flip_object(std::move(map), std::move(result), reference);
}

py::object hdr_several(const InputImage& reference, const std::vector<py::object>& objects,
                       const On<HdrFlipOptions>& options) {
    std::vector<std::unique_ptr<InputImage>> tests;
    std::vector<const OIIO::ImageBuf*> images;
    for (const py::object& object : objects) {
        const std::string where = "hdr_flip: test[" + std::to_string(tests.size()) + "]";
        tests.push_back(std::make_unique<InputImage>(object, where));
        images.push_back(&tests.back()->buf());
    }
    std::vector<OIIO::ImageBuf> maps;
    std::vector<FlipResult> results;
    bool done = false;
    {
        const py::gil_scoped_release others_may_run;
        done = ToneAlgo::hdr_flip(maps, reference.buf(), images, options, &results, options.roi,
                                  options.nthreads);
    }
    if (!done)
        throw Refused(maps.front().geterror());
    py::list all;
    for (size_t i = 0; i < maps.size(); ++i)
        all.append(flip_object(std::move(maps[i]), std::move(results[i]), reference));
    return py::object(std::move(all));
}

py::object hdr(std::vector<py::object>& images, const On<HdrFlipOptions>& options) {
    const InputImage reference(images[0], "hdr_flip: reference");
    if (py::isinstance<py::list>(images[1]) || py::isinstance<py::tuple>(images[1]))
        return hdr_several(reference, to_items(images[1], "hdr_flip: test", "Sequence[Image]"),
                           options);
    return hdr_one(reference, InputImage(images[1], "hdr_flip: test"), options);
}

struct StripOptions : HdrFlipOptions, ToneAlgo::FilmstripOptions {
    int nthreads = 0;
};

py::object filmstrip(std::vector<py::object>& images, const StripOptions& options) {
    const InputImage reference(images[0], "flip_filmstrip: reference");
    const InputImage test(images[1], "flip_filmstrip: test");
    FlipResult result;
    OIIO::ImageBuf image = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::flip_filmstrip(dst, reference.buf(), test.buf(), options, options, &result,
                                        options.nthreads);
    });
    return py::cast(FilmstripObject{
        {to_python(std::move(image), OutputKind::picture(reference)), std::move(result.summary)}});
}

void add_flips(Module& module) {
    using L = On<FlipOptions>;
    using H = On<HdrFlipOptions>;
    const std::string summary_text =
        "The map, and in `summary` all that is needed to repeat and to trust it.";
    define(module,
           Description{"ldr_flip",
                       "LDR-FLIP: how different two pictures for a screen look.",
                       {reference_parameter(), test_parameter()},
                       "FlipResult",
                       summary_text,
                       pair_notes(kMapNotes + "\nValues are clamped to 0 to 1 in linear Rec.709."),
                       kPairErrors,
                       kSourceLdr},
           joined<L>({flip_fields<L>(), {roi_field<L>(), threads_field<L>()}}), ldr);
    Parameter tests = test_parameter();
    tests.type = "Image | Sequence[Image]";
    tests.text += " A list of them: each against the reference, which is prepared once.";
    define(
        module,
        Description{"hdr_flip",
                    "HDR-FLIP: how different two HDR pictures look at any exposure a viewer may "
                    "pick: the maximum of LDR-FLIP over exposures, tone mapped.",
                    {reference_parameter(), tests},
                    "FlipResult",
                    summary_text + " A list of such, one each, for a list of tests.",
                    pair_notes(kMapNotes + "\nUnits: scene light, whatever it is in; exposures in "
                                           "stops. Negative components count as 0."),
                    kPairErrors + " An all-black reference without exposures.",
                    kSourceHdr},
        joined<H>({hdr_fields<H>(), {roi_field<H>(), threads_field<H>()}}), hdr);
}

void add_filmstrip(Module& module) {
    using S = StripOptions;
    define(
        module,
        Description{"flip_filmstrip",
                    "Figure 1 of the HDR-FLIP paper: a column per exposure with reference, test "
                    "and LDR-FLIP, at the right HDR-FLIP (magma) and the exposure map (viridis).",
                    {reference_parameter(), test_parameter()},
                    "FilmstripResult",
                    "The picture, R, G, B, sRGB-encoded, and the summary.",
                    pair_notes("Units: sizes in pixels; labels in stops. NaN, Inf: as hdr_flip."),
                    kPairErrors,
                    kSourceHdr},
        joined<S>(
            {hdr_fields<S>(),
             {field<S>("thumb_width", &S::thumb_width,
                       "Width of one picture in pixels, 32 to 4096."),
              field<S>("max_columns", &S::max_columns,
                       "At most this many exposures are shown, at least 1."),
              field<S>("font", &S::font, "Font file; \"\": DejaVu Sans."), threads_field<S>()}}),
        filmstrip);
}

} // namespace

void add_flip(Module& module) {
    add_flip_results(module);
    add_flips(module);
    add_filmstrip(module);
    define_names(module, "flip_tonemappers", "Names of the tone curves of HDR-FLIP.", kSourceHdr,
                 ToneAlgo::flip_tonemappers);
    define_names(module, "flip_quantities", "Names of the quantities of flip_quantity().",
                 kSourceHdr, ToneAlgo::flip_quantities);
}

} // namespace tonetool::python
