// SPDX-License-Identifier: BSD-3-Clause
// Bloom.
#include "tonetool/bloom.h"

#include "imagebuf/options/bloom_options.h"
#include "python/families.h"
#include "python/results.h"

namespace tonetool::python {

namespace {

using BloomCall = On<BloomOptions>;
using BloomObject = Imaged<BloomSummary>;

py::object run_bloom(std::vector<py::object>& images, const BloomCall& options) {
    const InputImage image(images[0], "bloom: image");
    BloomSummary summary;
    OIIO::ImageBuf result = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::bloom(dst, image.buf(), options, &summary, options.roi, options.nthreads);
    });
    return py::cast(BloomObject{to_python(std::move(result), OutputKind::picture(image)), summary});
}

void add_bloom_results(Module& module) {
    using S = BloomSummary;
    ResultClass<S> result(module, "BloomSummary", "Which light was spread, and how far.");
    visit_source<S>(visitor(result));
    result.field("threshold", &S::threshold, "Luminance above which light spreads.")
        .field("lwa", &S::lwa, "What a threshold in stops is above; 0: there is no such threshold.")
        .field("fov", &S::fov, "Degrees of the picture's width; 0: psf=\"gaussian\".")
        .field("reach", &S::reach, "How far light is spread, in pixels.")
        .field("kept", &S::kept, "Share of the spread light that stays in its pixel.")
        .field("light", &S::light, "Share of the light that is above the threshold.")
        .field("spreading", &S::spreading, "Pixels above the threshold.")
        .field("nonfinite", &S::nonfinite, "Pixels with NaN or Inf.")
        .field("warnings", &S::warnings, "What a user must know, one sentence each.")
        .field("notes", &S::notes, "What was assumed.")
        .finish();
    ResultClass<BloomObject>(module, "BloomResult", "A picture with bloom and its summary.")
        .object("image", &BloomObject::image, "Image", "The picture, linear.")
        .field("summary", &BloomObject::summary, "What it was made with.")
        .finish();
}

} // namespace

void add_bloom(Module& module) {
    add_bloom_results(module);
    define(module,
           Description{
               "bloom",
               "Spread the light of bright pixels, as in the eye or a lens: C + amount (PSF * E - "
               "E), E = C max(0, L - threshold) / L.",
               {image_parameter("image", "Needs R, G, B, linear; other channels are carried.")},
               "BloomResult",
               "The picture, float and linear, with the channels of the image.",
               "Shapes: height x width x channels, R, G, B first, or an ImageBuf; the result is "
               "what the image is.\nUnits, colour: linear light in the image's own primaries; the "
               "threshold is a luminance of linear Rec.709 in its unit.\nAlpha: carried, no light "
               "is added to it. Light that leaves the image is lost.\nNaN, Inf: such pixels stay "
               "as they are and give no light, nor do negative components.",
               "No colour, a display-encoded image, deep images, an unknown name, a value out of "
               "range, an option of the other psf.",
               "G. Spencer, P. Shirley, K. Zimmerman, D. Greenberg, \"Physically-Based Glare "
               "Effects for Digital Images\", 1995; M. Pettineo, \"A Closer Look at Tone "
               "Mapping\", 2010."},
           joined<BloomCall>(
               {{field<BloomCall>("pixels", &BloomCall::pixels, "Layer and colour space.")},
                described<BloomCall, BloomOptions>(),
                {roi_field<BloomCall>(), threads_field<BloomCall>()}}),
           run_bloom);
}

} // namespace tonetool::python
