// SPDX-License-Identifier: BSD-3-Clause
// What each family of functions adds to the module.
#pragma once

#include "python/function.h"

namespace tonetool::python {

void add_pixels(Module& module);
void add_compare(Module& module); ///< what comparisons have in common
void add_flip(Module& module);
void add_flip_results(Module& module);
void add_evaluate(Module& module);
void add_bias(Module& module);
void add_errors(Module& module);
void add_tmqi(Module& module);
void add_shot(Module& module);
void add_bloom(Module& module);
void add_tonemap(Module& module);
void add_curves(Module& module);
void add_cgtmo(Module& module);
void add_lights(Module& module);
void add_luminance(Module& module);
void add_display(Module& module);
void add_lut(Module& module);
void add_qc(Module& module);
void add_against(Module& module);
void add_attribute(Module& module);
void add_write(Module& module);
void add_chain(Module& module);

} // namespace tonetool::python
