// Symbol visibility of the tonetool library: only what carries TONETOOL_API is exported.
#pragma once

#define TONETOOL_VERSION "0.1.0"

#if defined(__GNUC__) || defined(__clang__)
#define TONETOOL_API __attribute__((visibility("default")))
#else
#define TONETOOL_API
#endif

namespace tonetool {

/// Version of the library that is running, "major.minor.patch".
TONETOOL_API const char* version() noexcept;

} // namespace tonetool
