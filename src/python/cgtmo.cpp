// SPDX-License-Identifier: BSD-3-Clause
// CG-TMO.
#include "tonetool/cgtmo.h"

#include <algorithm>
#include <map>
#include <optional>

#include "imagebuf/options/cgtmo_options.h"
#include "python/families.h"
#include "python/lights.h"
#include "python/shot.h"
#include "tonetool/shot.h"

namespace tonetool::python {

namespace {

struct O : On<CgTmoOptions> {
    std::map<int, py::object> images; ///< of other frames, by their numbers
};
using CgTmoObject = Imaged<CgTmoSummary>;

std::map<int, py::object> images_of(py::handle value, const std::string& where) {
    std::map<int, py::object> images;
    if (value.is_none())
        return images;
    if (!py::isinstance<py::dict>(value))
        wrong_type(where, value, "Mapping[int, Image] | None");
    for (const auto& [number, image] : py::reinterpret_borrow<py::dict>(value))
        images[Python<int>::from(number, where)] = py::reinterpret_borrow<py::object>(image);
    return images;
}

// What steady=True needs of the frames of its window; those that are not given are told later.
void make_frames(const InputImage& own, O& options) {
    std::vector<int> numbers;
    run_or_raise("cg_tmo", [&](std::string& error) {
        return ToneAlgo::steady_window(numbers, options.adapt, error);
    });
    for (const int number : numbers) {
        const auto given = options.images.find(number);
        const bool is_own = number == options.adapt.frame;
        if (given == options.images.end() && !is_own)
            continue;
        std::optional<InputImage> other;
        if (!is_own)
            other.emplace(given->second, "cg_tmo: frames[" + std::to_string(number) + "]");
        run_or_raise("cg_tmo", [&](std::string& error) {
            return ToneAlgo::steady_frame(options.frames[number], (other ? *other : own).buf(),
                                          error, options, options.nthreads);
        });
    }
}

Fields<O> cgtmo_fields() {
    Fields<O> fields =
        joined<O>({{field<O>("pixels", &O::pixels, "The beauty and its colour space.")},
                   described<O, CgTmoOptions>(),
                   {roi_field<O>(), threads_field<O>()}});
    const auto place = std::find_if(fields.begin(), fields.end(),
                                    [](const auto& row) { return row.name == "bias"; });
    fields.insert(
        place,
        {field<O>("lights", &O::lights, "The table of lights, and where they are told apart."),
         field<O>("adapt", &O::adapt, "The shot that it is exposed by; None: by itself."),
         {"frames", "Mapping[int, Image] | None", "None",
          "The frames up to 4 before and after, by their numbers, for steady=True; more do no "
          "harm.",
          [](O& options, py::handle value, const std::string& where) {
              options.images = images_of(value, where);
          }}});
    return fields;
}

py::object run_cgtmo(std::vector<py::object>& images, const O& given) {
    const InputImage image(images[0], "cg_tmo: image");
    O options = given;
    const bool adapts = options.adapt.adapt != "frame" || !options.adapt.statistics.frames.empty();
    if (options.steady && adapts)
        make_frames(image, options);
    CgTmoSummary summary;
    OIIO::ImageBuf result = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::cg_tmo(dst, image.buf(), options, &summary, options.roi, options.nthreads);
    });
    return py::cast(CgTmoObject{to_python(std::move(result), OutputKind::picture(image)), summary});
}

void add_cgtmo_results(Module& module) {
    using S = CgTmoSummary;
    ResultClass<S> result(module, "CgTmoSummary", "What CG-TMO found and used.");
    visit_source<S>(visitor(result));
    result.field("position", &S::position, "Layer that was used; \"\": none.")
        .field("normal", &S::normal, "Layer that was used; \"\": none.")
        .field("albedo", &S::albedo, "Layer that was used; \"\": none.")
        .field("depth", &S::depth, "Layer that was used; \"\": none.")
        .field("adaptation", &S::adaptation, "Lwa.")
        .field("maximum", &S::maximum, "Lmax.")
        .field("adaptation_from", &S::adaptation_from,
               "\"lwa\", \"camera\", \"env\", \"shot\", \"image\".")
        .field("unit", &S::unit, "cd/m2 of a pixel value of 1, with a camera; else 0.")
        .field("ev100", &S::ev100, "Exposure value of the camera at ISO 100; None: no camera.")
        .field("maximum_from", &S::maximum_from,
               "\"lmax\", \"lights\", \"groups\", \"env\", \"shot\", \"image\".")
        .field("adapted", &S::adapted, "Which shot that is; \"\": none.")
        .field("steady", &S::steady, "Numbers of the frames that were averaged; []: none.")
        .field("maximum_light", &S::maximum_light, "Whose maximum it is, of lights and groups.")
        .field("light_index", &S::light_index, "Where lights were told apart; \"\": nowhere.")
        .field("footprint", &S::footprint, "Median, in the unit of positions; 0: unknown.")
        .field("samples", &S::samples, "Neighbours of each pixel; 0: all.")
        .field("background", &S::background, "Pixels without a surface.")
        .field("counted", &S::counted, "Pixels whose light was measured.")
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
    add_cgtmo_results(module);
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
            "base. The result does not depend on ROI or threads to the bit.\nsteady=True: `frames` "
            "need not have one size; a frame whose positions tell no camera is tone mapped alone, "
            "with a warning.",
            "No colour, deep images, an unknown name, a value out of range, a layer that is not "
            "there, a table or panorama that cannot be read; steady=True without adapt, or without "
            "a "
            "frame of the statistics that is near.",
            "F. Banterle et al., CG-TMO; F. Drago et al., \"Adaptive Logarithmic Mapping for "
            "Displaying High Contrast Scenes\", 2003; F. Durand, J. Dorsey, 2002 (bilateral); Z. "
            "Farbman et al., 2008 (wls)."},
        cgtmo_fields(), run_cgtmo);
}

} // namespace tonetool::python
