# SPDX-License-Identifier: BSD-3-Clause
# Renders as tests of CTest: tonetool_add_image_test() and tonetool_add_suite_test().
#
# What makes an image is a test, too (DEPENDS), and a fixture of the check: if it fails, the check is
# not run, which CTest counts as a failure. Nothing here skips a test or expects it to fail.

# What has no limit cannot fail.
function(_tonetool_require_limit name)
  foreach(word IN LISTS ARGN)
    if(word MATCHES "^--?[a-z]+(:[^:]*)*:fail=." OR word MATCHES "^--?(diff|pdiff|biascheck|against)(:|$)")
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "tonetool_add_image_test(${name}): CHECK has no limit, so it could not fail "
    "(valid: CHECK --hdrflip:fail=mean=0.3)")
endfunction()

# The arguments that both functions have, after `required` is there.
function(_tonetool_check_arguments function name unknown missing required)
  if(unknown)
    message(FATAL_ERROR "${function}(${name}): unknown \"${unknown}\"")
  endif()
  if(missing)
    message(FATAL_ERROR "${function}(${name}): nothing behind ${missing}")
  endif()
  foreach(one IN LISTS required)
    if("${_${one}}" STREQUAL "")
      message(FATAL_ERROR "${function}(${name}): ${one} is missing")
    endif()
  endforeach()
  if(NOT TARGET tonetool::program)
    message(FATAL_ERROR "${function}(${name}): this installation has no program tonetool")
  endif()
  if("/${name}/" MATCHES "/\\.*/")
    message(FATAL_ERROR "${function}(${name}): a name is a path of folders, without . and ..")
  endif()
endfunction()

# The test itself; ARGN: the words of the command.
function(_tonetool_add_test function name)
  add_test(NAME "${name}" COMMAND tonetool::program ${ARGN} --ctest --images
    "${CMAKE_CURRENT_BINARY_DIR}/tonetool/${name}")
  foreach(one IN LISTS _DEPENDS)
    if(NOT TEST "${one}")
      message(FATAL_ERROR "${function}(${name}): DEPENDS \"${one}\" is no test of this folder "
        "(valid: one that add_test() has added before)")
    endif()
    set_property(TEST "${one}" APPEND PROPERTY FIXTURES_SETUP "tonetool.${one}")
    set_property(TEST "${name}" APPEND PROPERTY FIXTURES_REQUIRED "tonetool.${one}")
  endforeach()
  if(NOT "${_TIMEOUT}" STREQUAL "")
    set_property(TEST "${name}" PROPERTY TIMEOUT "${_TIMEOUT}")
  endif()
  if(NOT "${_LABELS}" STREQUAL "")
    set_property(TEST "${name}" PROPERTY LABELS "${_LABELS}")
  endif()
endfunction()

# tonetool_add_image_test(NAME render.glass TEST ${CMAKE_CURRENT_BINARY_DIR}/glass.exr
#   REFERENCE glass_ref.exr CHECK --hdrflip:fail=mean=0.3
#   [DEPENDS render_glass...] [TIMEOUT 60] [LABELS looks...])
#
# A relative REFERENCE is in the source folder, a relative TEST in the binary folder. Both are names
# of one file, whatever signs are in them. CHECK is what stands between them and the end of a command
# line. Where it does not pass, <binary folder>/tonetool/NAME/ has the images.
function(tonetool_add_image_test)
  cmake_parse_arguments(PARSE_ARGV 0 "" "" "NAME;TEST;REFERENCE;TIMEOUT" "CHECK;DEPENDS;LABELS")
  _tonetool_check_arguments(tonetool_add_image_test "${_NAME}" "${_UNPARSED_ARGUMENTS}"
    "${_KEYWORDS_MISSING_VALUES}" "NAME;TEST;REFERENCE;CHECK")
  _tonetool_require_limit("${_NAME}" ${_CHECK})
  foreach(one IN ITEMS TEST REFERENCE)
    set(base "${CMAKE_CURRENT_BINARY_DIR}")
    if(one STREQUAL "REFERENCE")
      set(base "${CMAKE_CURRENT_SOURCE_DIR}")
    endif()
    if(NOT "${_${one}}" MATCHES "^\\$<")
      get_filename_component(_${one} "${_${one}}" ABSOLUTE BASE_DIR "${base}")
    endif()
  endforeach()
  _tonetool_add_test(tonetool_add_image_test "${_NAME}" --wildcardoff "${_REFERENCE}" "${_TEST}"
    ${_CHECK})
endfunction()

# tonetool_add_suite_test(NAME lookdev SUITE suite.toml [DEPENDS ...] [TIMEOUT ...] [LABELS ...])
function(tonetool_add_suite_test)
  cmake_parse_arguments(PARSE_ARGV 0 "" "" "NAME;SUITE;TIMEOUT" "DEPENDS;LABELS")
  _tonetool_check_arguments(tonetool_add_suite_test "${_NAME}" "${_UNPARSED_ARGUMENTS}"
    "${_KEYWORDS_MISSING_VALUES}" "NAME;SUITE")
  get_filename_component(_SUITE "${_SUITE}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  _tonetool_add_test(tonetool_add_suite_test "${_NAME}" --suite "${_SUITE}")
endfunction()
