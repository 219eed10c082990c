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
if(TONETOOL_SANITIZE)
  return()
endif()

# Man pages are compressed where there is gzip; -n: the same page gives the same file.
find_program(TONETOOL_GZIP gzip DOC "gzip, for the man page")
mark_as_advanced(TONETOOL_GZIP)
set(manual_dir ${CMAKE_CURRENT_BINARY_DIR}/manual)
set(write_manual ${PROJECT_SOURCE_DIR}/src/cmake/write_manual.cmake)
set(man_page tonetool.1)
if(TONETOOL_GZIP)
  set(man_page tonetool.1.gz)
endif()
add_custom_command(TARGET tonetool_program POST_BUILD
  COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:tonetool_program> -DFOLDER=${manual_dir}
          -DGZIP=${TONETOOL_GZIP} -P ${write_manual}
  COMMENT "Writing the man page and completions" VERBATIM)
set_property(TARGET tonetool_program APPEND PROPERTY LINK_DEPENDS ${write_manual})

install(FILES ${manual_dir}/${man_page} DESTINATION ${TONETOOL_MAN_DIR}/man1)
install(FILES ${manual_dir}/tonetool.bash DESTINATION ${TONETOOL_BASH_DIR} RENAME tonetool)
install(FILES ${manual_dir}/tonetool.zsh DESTINATION ${TONETOOL_ZSH_DIR} RENAME _tonetool)
install(FILES ${manual_dir}/tonetool.fish DESTINATION ${TONETOOL_FISH_DIR})
