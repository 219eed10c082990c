// SPDX-License-Identifier: BSD-3-Clause
// Symbol visibility of the tonetool library: only what carries TONETOOL_API is exported.
//
// Before 1.0 a new minor version may change names, signatures and behaviour, without an alias for
// the old name; a patch version changes neither the API nor the ABI. The structs of options and
// results have public fields, which are part of the ABI: a new field moves the others. Therefore
// recompile for each minor version; the soname (libtonetool.so.MAJOR.MINOR) and the CMake package
// hold to that.
#pragma once

#include "tonetool/version.h" // TONETOOL_VERSION, "major.minor.patch"

#if defined(__GNUC__) || defined(__clang__)
#define TONETOOL_API __attribute__((visibility("default")))
#else
#define TONETOOL_API
#endif

namespace tonetool {

/// Version of the library that is running, "major.minor.patch".
TONETOOL_API const char* version() noexcept;

} // namespace tonetool
