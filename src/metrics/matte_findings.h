// SPDX-License-Identifier: BSD-3-Clause
// Objects of two coverages, and which of them have changed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "metrics/coverage.h"
#include "tonetool/attribute_numbers.h"

namespace tonetool::metrics {

/// The rows of a type with their findings: those with one first, then by falling mass, then by
/// name. `name_of` gives the name of an id other than Coverage::kNone.
std::vector<AttributedMatte> attributed_mattes(const Coverage& reference, const Coverage& test,
                                               const CoveredPixels& pixels,
                                               const std::function<std::string(uint32_t)>& name_of);

} // namespace tonetool::metrics
