# SPDX-License-Identifier: BSD-3-Clause
# Writes into FOLDER what PROGRAM prints as its man page and as completions for shells.
cmake_minimum_required(VERSION 3.25)

file(MAKE_DIRECTORY "${FOLDER}")
foreach(format IN ITEMS man bash zsh fish)
  set(file "${FOLDER}/tonetool.${format}")
  if(format STREQUAL man)
    set(file "${FOLDER}/tonetool.1")
  endif()
  execute_process(COMMAND "${PROGRAM}" --help=${format} OUTPUT_FILE "${file}"
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(GZIP)
  execute_process(COMMAND "${GZIP}" -9nfk "${FOLDER}/tonetool.1" COMMAND_ERROR_IS_FATAL ANY)
endif()
