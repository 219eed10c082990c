# SPDX-License-Identifier: BSD-3-Clause
# The folder of all sources: also where the Python module alone is the project.
get_filename_component(TONETOOL_SOURCE_DIR ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)

option(TONETOOL_UNITY_BUILD "Compile several sources of a folder together, in half the time" ON)

# The rooms, from the ground up. A room links only the rooms above it in this list, so that the
# link lines keep the order.
function(tonetool_room name)
  get_filename_component(tonetool_rooms ${CMAKE_CURRENT_FUNCTION_LIST_DIR} DIRECTORY)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  add_library(tonetool_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(tonetool_${name} PUBLIC
    ${tonetool_rooms} ${tonetool_rooms}/include)
  target_link_libraries(tonetool_${name} PRIVATE tonetool_flags PUBLIC ${ROOM_LIBRARIES})
  foreach(room IN LISTS ROOM_ROOMS)
    target_link_libraries(tonetool_${name} PUBLIC tonetool_${room})
  endforeach()
  # Half of what it takes to compile a file of these are the headers that all of them include.
  if(TONETOOL_UNITY_BUILD AND name MATCHES "^(imagebuf|sequence|chain|runs|recipe|text)$")
    set_target_properties(tonetool_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
  # The rooms above libtonetool call what computes: with the last -O they compile in two thirds of the
  # time and run as fast. The first one precompiles headers for all, which therefore have its flags;
  # imagebuf, compiled with what Highway defines, precompiles its own.
  if(TARGET tonetool_text)
    target_compile_options(tonetool_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  if(TARGET tonetool_text AND NOT name STREQUAL text)
    target_precompile_headers(tonetool_${name} REUSE_FROM tonetool_text)
  endif()
endfunction()

set(tonetool_precompiled
  <OpenImageIO/imagebufalgo.h> <algorithm> <functional> <map> <string> <vector>)
