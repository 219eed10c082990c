// SPDX-License-Identifier: BSD-3-Clause
// Whose error is it: by light groups, Cryptomatte and the other layers of a pair.
#include "tonetool/attribute.h"

#include "imagebuf/options/attribute_fields.h"
#include "imagebuf/options/attribute_options.h"
#include "python/compare.h"
#include "python/families.h"

namespace tonetool::python {

namespace {

struct AttributeCall : AttributeOptions {
    int nthreads = 0;
};

Fields<AttributeCall> attribute_keywords() {
    using O = AttributeCall;
    return joined<O>(
        {described<O, AttributeOptions>(),
         ignore_fields<O>(),
         {field<O>("pixels", &O::pixels, "Layer and colour space, for both images."),
          field<O>("size", &O::size,
                   "Different display windows are an error (\"match\"), or only where they meet is "
                   "looked at (\"crop\"); \"resize\" is an error."),
          field<O>("memory", &O::memory,
                   "Bytes for the layers of both images and for the tests that are measured at "
                   "once; too few for the layers are an error. 0: 2 GiB of tests.")},
         described<O, FlipOptions>(),
         {field<O>("curve", &O::curve, "Tone curve of HDR-FLIP; None: aces as in the paper."),
          field<O>("view", &O::view,
                   "A view of an OpenColorIO configuration instead of the curve.")},
         described<O, HdrFlipOptions>(),
         {threads_field<O>()}});
}

// Findings are sentences, as the program prints them.
struct AttributeObject : AttributeResult {
    std::vector<std::string> findings;
};

py::object attributed(std::vector<py::object>& images, const AttributeCall& options) {
    const InputImage reference(images[0], "attribute: reference");
    const InputImage test(images[1], "attribute: test");
    AttributeObject out;
    run_or_raise("attribute", [&](std::string& error) {
        return ToneAlgo::attribute(out, {&reference.buf()}, {&test.buf()}, error, options, nullptr,
                                   options.nthreads);
    });
    out.findings = ToneAlgo::attribute_findings(out);
    return py::cast(std::move(out));
}

template <class Row>
void add_rows(Module& module, const char* name, const char* text) {
    ResultClass<Row> rows(module, name, text);
    visit_fields(static_cast<const Row*>(nullptr), visitor(rows));
    rows.finish();
}

void add_attribute_results(Module& module) {
    add_rows<AttributedLight>(module, "AttributedLight",
                              "A light group, and how the error changes with it.");
    add_rows<AttributedMatte>(module, "AttributedMatte",
                              "An object or material, and the error under it.");
    add_rows<AttributedLayer>(module, "AttributedLayer", "Another layer that both images have.");
    add_rows<AttributedManifest>(module, "AttributedManifest",
                                 "Names that only one side's manifest has.");
    using T = AttributedType;
    ResultClass<T>(module, "AttributedType", "The rows of one Cryptomatte.")
        .field("type", &T::type, "Its name: \"ViewLayer.CryptoObject\".")
        .field("mattes", &T::mattes, "Findings first, then the largest part of the error.")
        .finish();
    using R = AttributeObject;
    ResultClass<R>(module, "AttributeResult", "Where the error of a pair lies.")
        .field("findings", &R::findings, "What has changed, as sentences.")
        .field("mean", &R::mean, "Of the error.")
        .field("lights", &R::lights, "Findings first, then what explains most.")
        .field("mattes", &R::mattes, "One each, that of the objects first.")
        .field("layers", &R::layers, "Findings first.")
        .field("manifest_only", &R::manifest_only, "One for each that differs.")
        .field("warnings", &R::warnings, "What could not be told and why, a sentence each.")
        .finish();
}

} // namespace

void add_attribute(Module& module) {
    add_attribute_results(module);
    define(
        module,
        Description{
            "attribute",
            "Whose error is it: the lights, objects, materials and layers that the difference of "
            "two renders comes from.",
            {image_parameter("reference", "With all its layers; an ImageBuf has their names."),
             image_parameter("test", "The render that is judged, with the same layers.")},
            "AttributeResult",
            "Findings, and the numbers behind them.",
            "Shapes: ImageBufs with layers; of arrays of height x width x channels (R, G, B first) "
            "only the mean is told.\nUnits: shares from 0 to 1, gains as factors, shifts in "
            "pixels.\nColour: as hdr_flip. Alpha: not compared.\nNaN, Inf: such pixels are in no "
            "gain. The number of threads changes no bit.",
            "No picture among the layers, deep images, different display windows, ids that have "
            "been through half or a lossy compression, a value out of range, an unreadable file.",
            "Cryptomatte specification 1.2.0; J. Friedman, A. C. Jones, \"Fully automatic ID "
            "mattes with support for motion blur and transparency\", SIGGRAPH 2015 Posters; the "
            "metric's own source."},
        attribute_keywords(), attributed);
}

} // namespace tonetool::python
