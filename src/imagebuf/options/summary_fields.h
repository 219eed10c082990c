// SPDX-License-Identifier: BSD-3-Clause
// The fields of summaries that are shown in more than one place, each written once: what writes
// attributes, prints lines, keeps the record of a check or makes classes of Python visits them. A
// visitor is called with a SummaryField and a pointer to the member.
#pragma once

#include <cctype>
#include <cstdint>
#include <string>

#include "imagebuf/pixels/layer_name.h"
#include "tonetool/errors.h"
#include "tonetool/flip.h"
#include "tonetool/tmqi.h"

namespace tonetool {

struct SummaryField {
    const char* name; ///< of the member, and in Python: "alpha_ignored"
    const char* text; ///< what it means, with its unit; Python's documentation says it
    const char* attribute = nullptr; ///< where it is not as in "alphaIgnored"
    const char* key = nullptr;      ///< of lines and records, where it is not as in "alpha-ignored"
    const char* if_empty = nullptr; ///< what stands for an empty text
};

/// "referenceNonfinite" of nonfinite `of` the reference; after it the format's "FLIP:" or its like.
inline std::string attribute_name(const SummaryField& field, const std::string& of = "") {
    if (field.attribute)
        return field.attribute;
    std::string name = of;
    bool begins_word = !of.empty();
    for (const char* c = field.name; *c != 0; ++c) {
        if (*c != '_')
            name += begins_word ? char(std::toupper(*c)) : *c;
        begins_word = *c == '_';
    }
    return name;
}

/// "reference-nonfinite" of nonfinite `of` the reference.
inline std::string key_name(const SummaryField& field, const std::string& of = "") {
    if (field.key)
        return field.key;
    std::string name = of.empty() ? field.name : of + "-" + field.name;
    for (char& c : name)
        c = c == '_' ? '-' : c;
    return name;
}

/// What is said of a value; Python alone has it as it is.
inline std::string said(const SummaryField& field, const std::string& value) {
    return value.empty() && field.if_empty ? field.if_empty : value;
}
inline double said(const SummaryField&, double value) {
    return value;
}
inline int64_t said(const SummaryField&, int64_t value) {
    return value;
}

/// How an image was read: of any summary.
template <class S, class Visit>
void visit_source(const Visit& visit) {
    visit(SummaryField{"layer", "\"\" for the plain R, G, B.", nullptr, nullptr, kPlainLayer},
          &S::layer);
    visit(SummaryField{"space", "Colour space the stored values were read in."}, &S::space);
}

/// Of each image: how it was read, and what was found in it.
template <class Visit>
void visit_side(const Visit& visit) {
    using S = FlipSide;
    visit_source<S>(visit);
    visit(SummaryField{"nonfinite", "Pixels with NaN or Inf."}, &S::nonfinite);
    visit(SummaryField{"negative", "Pixels with a negative component, which counts as 0."},
          &S::negative);
    visit(SummaryField{"uncovered", "Compared pixels outside the data window: black."},
          &S::uncovered);
}

/// Counts of pixels that are bad in both images, or alike but for something.
template <class Visit>
void visit_pair_counts(const Visit& visit) {
    using S = PairSummary;
    visit(SummaryField{"nonfinite_both",
                       "Pixels that are NaN or Inf in both images and alike: error 0.",
                       "bothNonfinite", "nonfinite-in-both"},
          &S::nonfinite_both);
    visit(SummaryField{"nonfinite_unlike",
                       "Pixels that are NaN or Inf in both images, of another kind or beside other "
                       "values: they differ.",
                       "unlikeNonfinite"},
          &S::nonfinite_unlike);
    visit(SummaryField{"alpha_ignored", "Pixels whose alpha differs, where alpha is ignored."},
          &S::alpha_ignored);
}

/// Where a mask or a region was given; of PairSummary and BiasSummary.
inline constexpr SummaryField kIgnoredField{
    "ignored", "Part of the compared pixels that mask and ignore leave out; None: neither given."};

/// Where alpha is compared.
template <class Visit>
void visit_alpha(const Visit& visit) {
    using S = PairSummary;
    visit(SummaryField{"alpha_mean", "Mean of the difference of alpha.", "alphaMeanError"},
          &S::alpha_mean);
    visit(SummaryField{"alpha_max", "Its maximum,", "alphaMaxError"}, &S::alpha_max);
}

/// Where there are exposures, of FlipSummary or ErrorSummary.
template <class S, class Visit>
void visit_exposed_luminance(const Visit& visit) {
    visit(SummaryField{"max_luminance", "That gave the exposures; 0: not used."},
          &S::max_luminance);
    visit(SummaryField{"median_luminance", "That gave the exposures; 0: not used."},
          &S::median_luminance);
}

/// Where a view was shown through a table.
template <class Visit>
void visit_bake_error(const Visit& visit) {
    using S = FlipSummary;
    visit(SummaryField{"bake_error_max", "Largest error of the table, display light."},
          &S::bake_error_max);
    visit(SummaryField{"bake_error_mean", "Its mean error."}, &S::bake_error_mean);
}

/// Each where the metric has it, else 0.
template <class Visit>
void visit_metric_options(const Visit& visit) {
    using S = ErrorSummary;
    visit(SummaryField{"eps", "0: the metric has none."}, &S::eps);
    visit(SummaryField{"peak", "0: the metric has none."}, &S::peak);
}

/// Of the picture that TMQI judges.
template <class Visit>
void visit_shown_luminance(const Visit& visit) {
    using S = TmqiScore;
    visit(
        SummaryField{"mean", "Of the picture, 0 to 255, that n follows from.", nullptr, "ldr-mean"},
        &S::mean);
    visit(
        SummaryField{"deviation", "Of the picture, that n follows from.", nullptr, "ldr-deviation"},
        &S::deviation);
}

/// Of one image.
template <class Visit>
void visit_luminance(const Visit& visit) {
    using S = LuminanceStats;
    visit(SummaryField{"pixels", "In the data window or the region."}, &S::pixels);
    visit(SummaryField{"nonfinite", "With NaN or Inf: not in any figure below."}, &S::nonfinite);
    visit(SummaryField{"negative", "Finite, with a negative component, which counts as 0."},
          &S::negative);
    visit(SummaryField{"black", "Luminance exactly 0."}, &S::black);
    visit(SummaryField{"min", "Smallest."}, &S::min);
    visit(SummaryField{"max", "Largest."}, &S::max);
    visit(SummaryField{"mean", "Arithmetic mean."}, &S::mean);
    visit(SummaryField{"median", "The upper median, as HDR-FLIP takes it."}, &S::median);
    visit(SummaryField{"median_lit", "The same over luminance above 0."}, &S::median_lit);
    visit(SummaryField{"log_average", "Geometric mean over luminance above 0."}, &S::log_average);
    visit(SummaryField{"p1", "Nearest-rank percentile."}, &S::p1);
    visit(SummaryField{"p99", "Nearest-rank percentile."}, &S::p99);
    visit(SummaryField{"p999", "Percentile 99.9.", nullptr, "p99.9"}, &S::p999);
}

/// "S1" of the finest of TMQI's scales.
inline std::string scale_name(size_t scale) {
    return "S" + std::to_string(scale + 1);
}

} // namespace tonetool
