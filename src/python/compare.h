// SPDX-License-Identifier: BSD-3-Clause
// What the comparisons of two images have in common.
#pragma once

#include <string>

#include "imagebuf/options/ignore_options.h"
#include "python/images.h"
#include "python/results.h"
#include "tonetool/compare.h"

namespace tonetool::python {

template <>
struct Python<Mask> {
    static std::string wanted() { return "Image | NDArray[np.bool_] | str | None"; }
    static Mask from(py::handle v, const std::string& where);
    static py::object to(const Mask&) { return py::none(); }
};

/// mask and ignore.
template <class O>
Fields<O> ignore_fields() {
    return described<O, IgnoreOptions>();
}

template <class O>
Fields<O> pair_fields() {
    Fields<O> fields = {
        field<O>("pixels", &O::pixels, "Layer and colour space, for both images."),
        field<O>("size", &O::size,
                 "Different display windows are an error (\"match\"), the test is resized to the "
                 "reference's, or only where they meet is compared (\"crop\")."),
        field<O>("alpha", &O::alpha,
                 "\"error\": the difference of alpha joins the map; \"ignore\": it is not looked "
                 "at."),
        field<O>("memory", &O::memory,
                 "Bytes that a process without other work needs at most; larger images are read "
                 "from their files in bands. 0: bands where half of the physical memory is not "
                 "enough."),
        field<O>(
            "quantities", &O::quantities,
            "Quantities of the map to pool beside the usual ones: \"p99.95\" (any percentile), "
            "\"above0.2\" (the share of the pixels whose error is above 0.2)."),
    };
    return joined<O>({fields, ignore_fields<O>()});
}

template <class S>
void add_pair_summary(ResultClass<S>& result) {
    result.field("pool", &S::pool, "Pooled values of the map.")
        .field("reference", &S::reference, "How the reference was read.")
        .field("test", &S::test, "How the test was read.");
    visit_pair_counts(visitor(result));
    result.field("region", &S::region, "Pixels compared.")
        .field(kIgnoredField.name, &S::ignored, kIgnoredField.text)
        .field("alpha_compared", &S::alpha_compared, "Alpha is part of the map.");
    visit_alpha(visitor(result));
    result.field("alpha_max_x", &S::alpha_max_x, "its column,")
        .field("alpha_max_y", &S::alpha_max_y, "and its row.")
        .field("warnings", &S::warnings, "What a user must know, one sentence each.");
}

/// `text` says which exposures.
template <class S>
void add_exposures(ResultClass<S>& result, const char* text) {
    result.field("exposures", &S::exposures, text);
    visit_exposed_luminance<S>(visitor(result));
    result.field("median_of_lit", &S::median_of_lit,
                 "More than half of the reference is black: the median is that of the rest.");
}

inline Parameter reference_parameter() {
    return image_parameter("reference", "Needs R, G, B; other channels are ignored.");
}
inline Parameter test_parameter() {
    return image_parameter("test", "The image that is judged; of any type of image.");
}

/// Notes that the documentation of every comparison has.
inline std::string pair_notes(const std::string& first) {
    return first +
           "\nShapes: arrays of height x width x channels (R, G, B first) or ImageBufs; "
           "the map is of one channel, height x width, of the union of the data windows.\n"
           "Colour: brought to linear Rec.709 by matrix; arrays are taken for linear Rec.709 "
           "unless pixels={\"from\": ...} says otherwise.\n"
           "Alpha: ignored unless alpha=\"error\".\n"
           "The map is an array if the reference is one, else an ImageBuf. Identical images give "
           "exactly 0; the number of threads changes no bit. Images must not be written to by "
           "another thread meanwhile.";
}

} // namespace tonetool::python
