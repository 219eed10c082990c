# SPDX-License-Identifier: BSD-3-Clause
# What there is to read. Installed, the pages lie together, and links between them say so.
set(documents ${CMAKE_CURRENT_BINARY_DIR}/documents)

function(tonetool_page from to)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${from})
  file(READ ${PROJECT_SOURCE_DIR}/${from} text)
  foreach(name IN ITEMS doc/ CHANGELOG.md THIRD_PARTY.md)
    string(REPLACE "src/${name}" "${name}" text "${text}")
  endforeach()
  # From doc/ the top is one folder up, from doc/reference/ two.
  string(REGEX REPLACE "\\.\\./((\\.\\./)+(README\\.md|LICENSE))" "\\1" text "${text}")
  file(WRITE ${documents}/${to} "${text}")
endfunction()

file(REMOVE_RECURSE ${documents})
foreach(page IN ITEMS README.md LICENSE src/THIRD_PARTY.md src/CHANGELOG.md)
  cmake_path(GET page FILENAME name)
  tonetool_page(${page} ${name})
endforeach()
file(GLOB_RECURSE pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
  ${PROJECT_SOURCE_DIR}/src/doc/*.md)
foreach(page IN LISTS pages)
  cmake_path(RELATIVE_PATH page BASE_DIRECTORY src OUTPUT_VARIABLE name)
  tonetool_page(${page} ${name})
endforeach()
install(DIRECTORY ${documents}/ DESTINATION ${CMAKE_INSTALL_DOCDIR})
