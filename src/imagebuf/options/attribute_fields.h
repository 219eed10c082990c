// SPDX-License-Identifier: BSD-3-Clause
// The fields of what attribute() finds, each written once: the record of a check and the classes of
// Python visit them (see summary_fields.h).
#pragma once

#include "imagebuf/options/summary_fields.h"
#include "tonetool/attribute_numbers.h"

namespace tonetool {

template <class Visit>
void visit_fields(const AttributedLight*, const Visit& visit) {
    using L = AttributedLight;
    visit(SummaryField{"name", "Of the light group, or \"(rest)\"."}, &L::name);
    visit(SummaryField{"finding", "\"off\", \"weaker\", \"stronger\", \"new\" or \"\"."},
          &L::finding);
    visit(SummaryField{"mean_replaced", "Mean error with the reference's light in this group."},
          &L::mean_replaced);
    visit(SummaryField{"explains", "Part of the mean error that this takes away."}, &L::explains);
    visit(SummaryField{"mean_alone", "Mean error of the test's light in this group alone."},
          &L::mean_alone);
    visit(SummaryField{"gain", "Its light in the test as a factor of the reference's,"}, &L::gain);
    visit(SummaryField{"gain_error", "and the standard error of that."}, &L::gain_error);
}

template <class Visit>
void visit_fields(const AttributedMatte*, const Visit& visit) {
    using M = AttributedMatte;
    visit(SummaryField{"name", "By the manifest, \"<0f3c9a21>\" or \"(none)\"."}, &M::name);
    visit(SummaryField{"finding", "What has become of it, or \"\"."}, &M::finding);
    visit(SummaryField{"mass", "Part of the error that lies under it."}, &M::mass);
    visit(SummaryField{"mean", "Mean error under it."}, &M::mean);
    visit(SummaryField{"pixels_reference", "Sum of its coverage in the reference,"},
          &M::pixels_reference);
    visit(SummaryField{"pixels_test", "and in the test."}, &M::pixels_test);
    visit(SummaryField{"cover", "Part of its coverage that differs."}, &M::cover);
    visit(SummaryField{"gained", "Coverage that only the test has,"}, &M::gained);
    visit(SummaryField{"lost", "and that only the reference has."}, &M::lost);
    visit(SummaryField{"changed", "Pixels whose coverage differs by half or more."}, &M::changed);
    visit(SummaryField{"shift", "Of its centroid, in pixels to the right and down."}, &M::shift);
    visit(SummaryField{"gain", "R, G, B as factors of the reference's, where both cover,"},
          &M::gain);
    visit(SummaryField{"gain_error", "and their standard errors."}, &M::gain_error);
}

template <class Visit>
void visit_fields(const AttributedLayer*, const Visit& visit) {
    using L = AttributedLayer;
    visit(SummaryField{"name", "Of the layer."}, &L::name);
    visit(SummaryField{"kind", "\"depth\", \"position\", \"normal\", \"id\", \"albedo\" or "
                               "\"color\"."},
          &L::kind);
    visit(SummaryField{"finding", "\"changed\", as of a light, or \"\"."}, &L::finding);
    visit(SummaryField{"unit", "Of mean and max."}, &L::unit);
    visit(SummaryField{"mean", "Mean difference where both have a surface."}, &L::mean);
    visit(SummaryField{"max", "The largest."}, &L::max);
    visit(SummaryField{"changed", "Pixels beyond the limit of the kind."}, &L::changed);
    visit(SummaryField{"background_changed", "Of them those with a surface in only one image."},
          &L::background_changed);
    visit(SummaryField{"gain", "Of colours: light as a factor of the reference's,"}, &L::gain);
    visit(SummaryField{"gain_error", "and the standard error of that."}, &L::gain_error);
    visit(SummaryField{"most_under", "Shares of the changed pixels by object, two at most."},
          &L::most_under);
}

template <class Visit>
void visit_fields(const AttributedManifest*, const Visit& visit) {
    using M = AttributedManifest;
    visit(SummaryField{"type", "Of the Cryptomatte."}, &M::type);
    visit(SummaryField{"reference", "Names that only the reference's manifest has."},
          &M::reference);
    visit(SummaryField{"test", "Names that only the test's manifest has."}, &M::test);
}

} // namespace tonetool
