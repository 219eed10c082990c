// CG-TMO.
#include "tonetool/cgtmo.h"

#include "python/families.h"
#include "python/lights.h"

namespace tonetool::python {

template <>
struct Python<CgTmoSummary> : Nested<CgTmoSummary> {
    static std::string given() { return "CgTmoSummary"; }
};

namespace {

using O = On<CgTmoOptions>;
using CgTmoObject = Imaged<CgTmoSummary>;

Fields<O> guide_fields() {
    return {
        field<O>("pixels", &O::pixels, "The beauty and its colour space."),
        field<O>("preset", &O::preset,
                 "\"default\", or \"paper\": Eq. 2 and 4 to the letter. What follows overrides."),
        field<O>("domain", &O::domain, "Of the base: \"log\", \"linear\"; \"\": the preset's."),
        field<O>("lumsigma", &O::lumsigma,
                 "Of the luminance term in log10, 0 (none) to 10; None: the preset's."),
        field<O>("position", &O::position,
                 "Layer, or file that has it; \"none\": without; \"\": found by its name."),
        field<O>("normal", &O::normal, "As position."),
        field<O>("albedo", &O::albedo, "As position."),
        field<O>("depth", &O::depth, "As position; positions are made of it where there are none."),
        field<O>("fov", &O::fov,
                 "Horizontal field of view in degrees, 1 to 179; None: the image's own, or 40."),
        field<O>("strict", &O::strict,
                 "A missing guide, light or panorama that was asked for is an error."),
        field<O>("sigma", &O::sigma, "Of the window in pixels, 1 to 20."),
        field<O>("samples", &O::samples, "Of the window, 4 to 400; 0: all."),
        field<O>("normaldist", &O::normaldist, "\"euclid\": |n - m|^2; \"dot\": 1 - |n m|."),
        field<O>("footprint", &O::footprint,
                 "\"pixel\", \"global\", \"camera\", or a number in the unit of the positions."),
        field<O>("filter", &O::filter,
                 "\"guided\", \"bilateral\", \"wls\" (weighted least squares) or \"none\"."),
        field<O>("wlsalpha", &O::wlsalpha, "Sensitivity of wls to edges, 0 to 4 (1.2)."),
        field<O>("wlslambda", &O::wlslambda, "Smoothness of the base of wls, 0 to 100 (0.125)."),
    };
}

Fields<O> curve_fields() {
    return {
        field<O>("lwa", &O::lwa,
                 "Adaptation luminance: \"geometric\", \"harmonic\", \"arithmetic\" or \"median\" "
                 "of the panorama, or of the image; or a number as a str."),
        field<O>("env", &O::env, "File of a panorama at the camera, in the image's unit."),
        field<O>("weight", &O::weight, "Of the panorama: \"solidangle\" or \"none\"."),
        field<O>("lmax", &O::lmax, "Luminance that becomes white; None: as maximum says."),
        field<O>("maximum", &O::maximum,
                 "\"lights\", \"groups\", \"env\", \"image\"; \"auto\": the first there is."),
        field<O>("max_percentile", &O::max_percentile,
                 "Of groups and image, instead of their largest; 50 to 100."),
        field<O>("lights", &O::lights, "The table of lights, and where they are told apart."),
        field<O>("bias", &O::bias, "Of Drago's curve, 0.01 to 1."),
        field<O>("ldmax", &O::ldmax, "cd/m2 of the display, 1 to 10000."),
        field<O>("saturation", &O::saturation, "C' = (C / L)^saturation Ld, 0 to 4."),
        field<O>("encode", &O::encode, "Of the result, one of display_encodings()."),
        field<O>("clamp", &O::clamp, "The result to 0 to 1."),
        field<O>("show", &O::show, "\"picture\"; or its \"base\" or \"detail\", linear."),
        roi_field<O>(),
        threads_field<O>(),
    };
}

py::object run(std::vector<py::object>& images, const O& options) {
    const InputImage image(images[0], "cg_tmo: image");
    CgTmoSummary summary;
    OIIO::ImageBuf result = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::cg_tmo(dst, image.buf(), options, &summary, options.roi, options.nthreads);
    });
    return py::cast(CgTmoObject{to_python(std::move(result), OutputKind::picture(image)), summary});
}

void add_results(Module& module) {
    using S = CgTmoSummary;
    ResultClass<S>(module, "CgTmoSummary", "What CG-TMO found and used.")
        .field("layer", &S::layer, "\"\" for the plain R, G, B.")
        .field("space", &S::space, "Colour space the stored values were read in.")
        .field("position", &S::position, "Layer that was used; \"\": none.")
        .field("normal", &S::normal, "Layer that was used; \"\": none.")
        .field("albedo", &S::albedo, "Layer that was used; \"\": none.")
        .field("depth", &S::depth, "Layer that was used; \"\": none.")
        .field("adaptation", &S::adaptation, "Lwa.")
        .field("maximum", &S::maximum, "Lmax.")
        .field("adaptation_from", &S::adaptation_from, "\"lwa\", \"env\", \"image\".")
        .field("maximum_from", &S::maximum_from,
               "\"lmax\", \"lights\", \"groups\", \"env\", \"image\".")
        .field("maximum_light", &S::maximum_light, "Whose maximum it is, of lights and groups.")
        .field("light_index", &S::light_index, "Where lights were told apart; \"\": nowhere.")
        .field("footprint", &S::footprint, "Median, in the unit of positions; 0: unknown.")
        .field("samples", &S::samples, "Neighbours of each pixel; 0: all.")
        .field("background", &S::background, "Pixels without a surface.")
        .field("nonfinite", &S::nonfinite, "Pixels with NaN or Inf.")
        .field("negative", &S::negative, "Pixels with a negative component.")
        .field("warnings", &S::warnings, "What a user must know, one sentence each.")
        .field("notes", &S::notes, "Choices that were not the only ones possible.")
        .finish();
    ResultClass<CgTmoObject>(module, "CgTmoResult", "A tone-mapped picture and its summary.")
        .object("image", &CgTmoObject::image, "Image", "The picture, with all its channels.")
        .field("summary", &CgTmoObject::summary, "What it was made with.")
        .finish();
}

} // namespace

void add_cgtmo(Module& module) {
    add_results(module);
    define(
        module,
        Description{
            "cg_tmo",
            "Tone map a rendered image locally, guided by the renderer's own position, normal and "
            "albedo: Drago's curve on a base of luminance, the detail multiplied back.",
            {image_parameter("image",
                             "Needs R, G, B; guides are other layers of it. An array has no "
                             "names of layers: image() gives it some.")},
            "CgTmoResult",
            "The picture, float, with the channels of the image.",
            "Shapes: height x width x channels, or an ImageBuf; the result is what the image is.\n"
            "Units, colour: as tonemap with a curve; positions and footprint in the unit of the "
            "scene.\nAlpha and other channels: carried. Missing guides are left out, with a "
            "warning.\nNaN, Inf, negative components: as tonemap; such pixels take no part in the "
            "base. The result does not depend on ROI or threads to the bit.",
            "No colour, deep images, an unknown name, a value out of range, a layer that is not "
            "there, a table or panorama that cannot be read.",
            "F. Banterle et al., CG-TMO; F. Drago et al., \"Adaptive Logarithmic Mapping for "
            "Displaying High Contrast Scenes\", 2003; F. Durand, J. Dorsey, 2002 (bilateral); Z. "
            "Farbman et al., 2008 (wls)."},
        joined<O>({guide_fields(), curve_fields()}), run);
}

} // namespace tonetool::python
