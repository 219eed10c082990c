# SPDX-License-Identifier: BSD-3-Clause
# The rooms of libtonetool as build/release has them. Fuzzed are texts, by clang; of the kernels it
# would make checks for half an hour, and nobody runs them there.
set(built ${PROJECT_SOURCE_DIR}/build/release/src)
foreach(room kernels flip tonemap metrics imagebuf)
  add_library(tonetool_${room} STATIC IMPORTED GLOBAL)
  set_target_properties(tonetool_${room} PROPERTIES
    IMPORTED_LOCATION ${built}/${room}/libtonetool_${room}.a
    INTERFACE_INCLUDE_DIRECTORIES
    "${PROJECT_SOURCE_DIR}/src;${PROJECT_SOURCE_DIR}/src/include;${TONETOOL_GENERATED}")
endforeach()
target_link_libraries(tonetool_metrics INTERFACE tonetool_kernels hwy::hwy)
target_link_libraries(tonetool_imagebuf INTERFACE tonetool_flip tonetool_tonemap tonetool_metrics
  OpenImageIO::OpenImageIO OpenColorIO::OpenColorIO)

add_library(tonetool SHARED IMPORTED GLOBAL)
set_target_properties(tonetool PROPERTIES
  IMPORTED_LOCATION ${built}/libtonetool.so
  INTERFACE_INCLUDE_DIRECTORIES
    "${PROJECT_SOURCE_DIR}/src;${PROJECT_SOURCE_DIR}/src/include;${TONETOOL_GENERATED}")
target_link_libraries(tonetool INTERFACE OpenImageIO::OpenImageIO)
