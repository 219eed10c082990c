# SPDX-License-Identifier: BSD-3-Clause
# Which names a shared library shows. GNU ld, gold, lld and mold take a list of them; where a linker
# does not, everything is shown that is not compiled as hidden, which adds instances of templates.
include(CheckLinkerFlag)
set(tonetool_any_map ${CMAKE_CURRENT_BINARY_DIR}/any.map)
file(WRITE ${tonetool_any_map} "{ local: *; };\n")
check_linker_flag(CXX "LINKER:--version-script=${tonetool_any_map}" TONETOOL_LINKER_TAKES_LISTS)

function(tonetool_exports target map)
  if(TONETOOL_LINKER_TAKES_LISTS)
    target_link_options(${target} PRIVATE "LINKER:--version-script=${map}")
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${map})
  endif()
endfunction()

# What stands for a file's own folder in the places where it looks for libraries.
set(TONETOOL_ORIGIN "$ORIGIN")
if(APPLE)
  set(TONETOOL_ORIGIN "@loader_path")
endif()
