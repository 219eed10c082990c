# SPDX-License-Identifier: BSD-3-Clause
# Writes OUT: what --licenses prints, FILES one after the other, as a C++ string.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/embed_text.cmake)

set(all "")
foreach(file IN LISTS FILES)
  file(READ "${file}" text)
  string(APPEND all "${text}\n")
endforeach()
set(code "// Made by embed_licences.cmake.\n#include \"chain/manual/licenses.h\"\n\n")
string(APPEND code "namespace tonetool::chain {\n\n")
embed_text(kLicenceTexts "${all}")
string(APPEND code "\n} // namespace tonetool::chain\n")
file(WRITE "${OUT}" "${code}")
