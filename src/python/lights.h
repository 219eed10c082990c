// SPDX-License-Identifier: BSD-3-Clause
// Options of lights, which other functions take, too.
#pragma once

#include "python/results.h"
#include "tonetool/lights.h"

namespace tonetool::python {

template <>
const Table<LightOptions>& table_of<LightOptions>();
template <>
struct Python<LightOptions> : PythonStruct<LightOptions> {};

} // namespace tonetool::python
