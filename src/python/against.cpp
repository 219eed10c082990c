// SPDX-License-Identifier: BSD-3-Clause
// A file compared with its approved version, layer by layer.
#include "tonetool/against.h"

#include "python/families.h"
#include "python/results.h"

namespace tonetool::python {

namespace {

struct ThreadedAgainst : AgainstOptions {
    int nthreads = 0;
};

py::object compared(std::vector<py::object>& images, const ThreadedAgainst& options) {
    const InputImage approved(images[0], "against_facts: approved");
    const InputImage image(images[1], "against_facts: image");
    AgainstFacts facts;
    run_or_raise("against_facts", [&](std::string& error) {
        return ToneAlgo::against_facts(facts, {&approved.buf()}, {&image.buf()}, error, options,
                                       options.nthreads);
    });
    return py::cast(facts);
}

void add_against_results(Module& module) {
    using N = AgainstName;
    ResultClass<N>(module, "AgainstName", "A layer of one of the files.")
        .field("name", &N::name, "\"\" for the plain R, G, B.")
        .field("kind", &N::kind,
               "\"position\", \"normal\", \"depth\", \"vector\", \"id\", \"albedo\", \"color\", "
               "\"group\" or \"data\".")
        .field("part", &N::part, "Index of its part of the file.")
        .field("other", &N::other, "Index of the same layer in the other file, or -1.")
        .field("channels", &N::channels, "As in the file.")
        .finish();
    using F = AgainstFile;
    ResultClass<F>(module, "AgainstFile", "A file by its header.")
        .field("parts", &F::parts, "One each.")
        .field("channels", &F::channels, "Data type by name, as in the file.")
        .field("layers", &F::layers, "Those that are compared.")
        .field("moment", &F::moment, "A hash of its depths and positions; \"\" without any.")
        .finish();
    using L = AgainstLayer;
    ResultClass<L>(module, "AgainstLayer", "What was measured of a layer that both have.")
        .field("name", &L::name, "In the new file.")
        .field("kind", &L::kind, "As of AgainstName.")
        .field("quantities", &L::quantities,
               "By kind: off, median, one, lost, mismatch, others, gain, blocks, one_finite...")
        .field("x", &L::x, "Column where they differ most.")
        .field("y", &L::y, "Row where they differ most.")
        .field("one_finite_x", &L::one_finite_x,
               "Column of the first pixel that is finite in only one; 0 without any.")
        .field("one_finite_y", &L::one_finite_y, "Row of that pixel.")
        .finish();
    using A = AgainstFacts;
    ResultClass<A>(module, "AgainstFacts", "A file and its approved version.")
        .field("approved", &A::approved, "The approved version.")
        .field("file", &A::file, "The new one.")
        .field("layers", &A::layers, "Those that both have.")
        .field("unused", &A::unused, "Patterns of kinds and skip that fit no layer.")
        .finish();
}

} // namespace

void add_against(Module& module) {
    add_against_results(module);
    define_names(module, "against_kinds", "What a layer may hold for against_facts().",
                 "The checks of chain(\"--against\").", ToneAlgo::against_kinds);
    define(
        module,
        Description{"against_facts",
                    "Compare each layer with that of the approved version: light by blocks, so "
                    "that other noise does not matter, data by values.",
                    {image_parameter("approved", "One part (subimage) with all its layers."),
                     image_parameter("image", "The same of the new version.")},
                    "AgainstFacts",
                    "The facts.",
                    "Shapes: height x width x channels, R, G, B first, or an ImageBuf. Units: "
                    "gains in stops, angles in degrees, motion in pixels, the rest are shares "
                    "from 0 to 1; colours are compared in linear Rec.709.\nNaN, Inf: counted in "
                    "neither light, as other values in data. Alpha is compared as values.",
                    "No picture among the layers, deep images, an unreadable file, an unknown "
                    "kind.",
                    "The checks of chain(\"--against\"), which judge these facts over a shot."},
        Fields<ThreadedAgainst>{
            field<ThreadedAgainst>("pixels", &ThreadedAgainst::pixels, "Layer and colour space."),
            field<ThreadedAgainst>("kinds", &ThreadedAgainst::kinds,
                                   "What layers hold, by name with * and ?, where their names "
                                   "do not tell."),
            field<ThreadedAgainst>("skip", &ThreadedAgainst::skip,
                                   "Layers that are not compared, by name with * and ?."),
            threads_field<ThreadedAgainst>()},
        compared);
}

} // namespace tonetool::python
