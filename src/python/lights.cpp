// SPDX-License-Identifier: BSD-3-Clause
// Light groups and panoramas.
#include "tonetool/lights.h"

#include "imagebuf/options/tone_options.h"
#include "python/families.h"
#include "python/lights.h"

namespace tonetool::python {

template <>
const Table<LightOptions>& table_of<LightOptions>() {
    using O = LightOptions;
    static const Table<O> table = {
        "LightOptions", "table", "Where the lights are told apart, and how bright each of them is",
        [] {
            Fields<O> fields = described<O, LightOptions>();
            // The command line names the layer in ways of each command: lightindex=, layer=.
            fields.insert(
                fields.begin() + 2,
                field<O>("layer", &O::layer,
                         "Layer with the index of a light in each pixel; \"groups\": made "
                         "of the light groups; \"\": one that is called so, else the "
                         "groups."));
            return fields;
        }()};
    return table;
}

namespace {

const std::string kLightsSource =
    "Layers of light groups as Blender, Cycles, Arnold, V-Ray and RenderMan "
    "name them; F. Banterle et al., CG-TMO.";

struct Index : LightOptions {
    PixelOptions pixels;
};
using IndexOptions = On<Index>;
struct StatsOptions : PanoramaOptions {
    int nthreads = 0;
};
using IndexObject = Imaged<LightIndexSummary>;

Fields<IndexOptions> index_fields() {
    Fields<IndexOptions> fields;
    for (const Field<LightOptions>& row : table_of<LightOptions>().fields)
        fields.push_back({row.name, row.type, row.initial, row.text, row.set});
    return joined<IndexOptions>(
        {fields,
         {field<IndexOptions>("pixels", &IndexOptions::pixels, "Layer and colour space."),
          roi_field<IndexOptions>(), threads_field<IndexOptions>()}});
}

py::object light_index(std::vector<py::object>& images, const IndexOptions& options) {
    const InputImage image(images[0], "light_index: image");
    LightIndexSummary summary;
    OIIO::ImageBuf map = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::light_index(dst, image.buf(), options, options.pixels, &summary,
                                     options.roi, options.nthreads);
    });
    return py::cast(IndexObject{to_python(std::move(map), OutputKind::map(image)), summary});
}

py::object panorama_stats(std::vector<py::object>& images, const StatsOptions& options) {
    const InputImage image(images[0], "panorama_stats: image");
    PanoramaStats stats;
    run_or_raise("panorama_stats", [&](std::string& error) {
        return ToneAlgo::panorama_stats(stats, image.buf(), error, options, options.nthreads);
    });
    return py::cast(stats);
}

void add_index_results(Module& module) {
    using G = LightGroupSummary;
    ResultClass<G>(module, "LightGroupSummary", "A group of lights in an image.")
        .field("name", &G::name, "Its name.")
        .field("layer", &G::layer, "Where it is.")
        .field("pixels", &G::pixels, "That have its index.")
        .field("maximum", &G::maximum, "Largest luminance in its layer; 0: it is black.")
        .field("luminance", &G::luminance, "By the table.")
        .finish();
    using S = LightIndexSummary;
    ResultClass<S>(module, "LightIndexSummary", "The light groups of an image.")
        .field("layer", &S::layer, "Of the picture.")
        .field("space", &S::space, "Colour space of the picture.")
        .field("groups", &S::groups, "One each, in the order of the index.")
        .field("unlit", &S::unlit, "Pixels without any light, of index -1.")
        .field("sum", &S::sum, "Light of all groups over that of the picture; 0: there is none.")
        .field("difference", &S::difference, "How far pixels are from it, over the same.")
        .field("warnings", &S::warnings, "What a user must know, one sentence each.")
        .finish();
    ResultClass<IndexObject>(module, "LightIndexResult", "The index of lights and its summary.")
        .object("map", &IndexObject::image, "Image", "Index of each pixel's light group, or -1.")
        .field("summary", &IndexObject::summary, "The groups.")
        .finish();
}

void add_panorama(Module& module) {
    using P = PanoramaStats;
    ResultClass<P> result(module, "PanoramaStats", "Luminances of a latitude-longitude panorama.");
    result.field("pixels", &P::pixels, "Of the display window.")
        .field("nonfinite", &P::nonfinite, "Not in any figure.")
        .field("negative", &P::negative, "With a negative component, which counts as 0.")
        .field("uncovered", &P::uncovered, "Outside the data window: not in any figure.")
        .field("geometric", &P::geometric, "Geometric mean of L + 1e-6.")
        .field("harmonic", &P::harmonic, "Harmonic mean of L + 1e-6.")
        .field("mean", &P::mean, "Arithmetic mean.")
        .field("median", &P::median, "Median.")
        .field("max", &P::max, "Maximum.");
    visit_source<P>(visitor(result));
    result.finish();
    using O = StatsOptions;
    define(
        module,
        Description{"panorama_stats",
                    "Measure a latitude-longitude panorama.",
                    {image_parameter("image", "Twice as wide as high; needs R, G, B.")},
                    "PanoramaStats",
                    "The figures.",
                    "Shapes: height x width x channels, R, G, B first, or an ImageBuf. Units: that "
                    "of the image, in linear Rec.709.\nNaN, Inf: counted and left out. Alpha: "
                    "ignored.",
                    "No colour, no finite pixel, deep images, not 2:1 where solid angles count.",
                    kLightsSource},
        Fields<O>{field<O>("pixels", &O::pixels, "Layer and colour space."),
                  field<O>("weight", &O::weight,
                           "\"solidangle\": a texel counts as the part of the sphere it covers; "
                           "\"none\": all count alike."),
                  threads_field<O>()},
        panorama_stats);
}

} // namespace

void add_lights(Module& module) {
    module.add_mapping(table_of<LightOptions>());
    add_index_results(module);
    define(module,
           Description{"light_index",
                       "Which light each pixel is lit by, from layers of light groups.",
                       {image_parameter("image", "With a layer per light group: an ImageBuf.")},
                       "LightIndexResult",
                       "The map, one channel, and in `summary` the groups.",
                       "Shapes: the map is height x width. Units: the place of the group in "
                       "summary.groups, -1: no light. Alpha: ignored.\nNaN, Inf, negative: black.",
                       "No groups, an unknown group, no colour, deep images, an unreadable table.",
                       kLightsSource},
           index_fields(), light_index);
    add_panorama(module);
}

} // namespace tonetool::python
