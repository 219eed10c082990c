# SPDX-License-Identifier: BSD-3-Clause
# The man page and the completions, which the program writes itself whenever it is linked. One that is
# built with a sanitizer is not installed.
set(TONETOOL_MAN_DIR ${CMAKE_INSTALL_MANDIR} CACHE STRING "Where the man page is installed")
set(TONETOOL_BASH_DIR ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  CACHE STRING "Where the completion for bash is installed")
set(TONETOOL_ZSH_DIR ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
  CACHE STRING "Where the completion for zsh is installed")
set(TONETOOL_FISH_DIR ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
  CACHE STRING "Where the completion for fish is installed")
# Man pages are compressed where there is gzip; -n: the same page gives the same file.
find_program(TONETOOL_GZIP gzip DOC "gzip, for the man pages")
mark_as_advanced(TONETOOL_GZIP)
if(TONETOOL_SANITIZE)
  return()
endif()

set(manual_dir ${CMAKE_CURRENT_BINARY_DIR}/manual)
set(write_manual ${PROJECT_SOURCE_DIR}/src/cmake/write_manual.cmake)
configure_file(${PROJECT_SOURCE_DIR}/src/farm/tonetool-slurm.1.in
  ${manual_dir}/tonetool-slurm.1 @ONLY)
set(suffix "")
if(TONETOOL_GZIP)
  set(suffix .gz)
  execute_process(COMMAND ${TONETOOL_GZIP} -9nfk ${manual_dir}/tonetool-slurm.1
    COMMAND_ERROR_IS_FATAL ANY)
endif()
add_custom_command(TARGET tonetool_program POST_BUILD
  COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:tonetool_program> -DFOLDER=${manual_dir}
          -DGZIP=${TONETOOL_GZIP} -P ${write_manual}
  COMMENT "Writing the man page and completions" VERBATIM)
set_property(TARGET tonetool_program APPEND PROPERTY LINK_DEPENDS ${write_manual})

install(FILES ${manual_dir}/tonetool.1${suffix} ${manual_dir}/tonetool-slurm.1${suffix}
  DESTINATION ${TONETOOL_MAN_DIR}/man1)
install(FILES ${manual_dir}/tonetool.bash DESTINATION ${TONETOOL_BASH_DIR} RENAME tonetool)
install(FILES ${manual_dir}/tonetool.zsh DESTINATION ${TONETOOL_ZSH_DIR} RENAME _tonetool)
install(FILES ${manual_dir}/tonetool.fish DESTINATION ${TONETOOL_FISH_DIR})
