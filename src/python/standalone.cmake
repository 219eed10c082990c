# SPDX-License-Identifier: BSD-3-Clause
# The module alone, against an installed libtonetool of this version (pip install ./src/python). The
# rooms above the library are compiled here: chain() runs them.
include(../cmake/language.cmake)

include(GNUInstallDirs)
# Structs of options are shared with the library: only the same version has the same.
find_package(tonetool ${PROJECT_VERSION} EXACT REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)
add_library(tonetool ALIAS tonetool::tonetool)
add_library(tonetool_flags INTERFACE)
target_compile_options(tonetool_flags INTERFACE -ffp-contract=off)

include(../cmake/rooms.cmake)
foreach(room text store sequence chain runs)
  add_subdirectory(../${room} ${room})
endforeach()
