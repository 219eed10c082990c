# SPDX-License-Identifier: BSD-3-Clause
# What another project needs of libtonetool: headers, CMake package, pkg-config file. All of them
# find each other by relative paths, so that an installed tree can be moved.
include(CMakePackageConfigHelpers)

set(tonetool_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tonetool)
set(tonetool_pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH tonetool_pc_prefix /${tonetool_pc_dir} /)
string(REGEX REPLACE "/$" "" tonetool_pc_prefix "${tonetool_pc_prefix}")
string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" tonetool_oiio "${OpenImageIO_VERSION}")
set(OpenImageIO_VERSION_MAJOR ${CMAKE_MATCH_1})
set(OpenImageIO_VERSION_MINOR ${CMAKE_MATCH_2})
math(EXPR tonetool_next_minor "${OpenImageIO_VERSION_MINOR} + 1")
set(tonetool_pc_next_oiio ${OpenImageIO_VERSION_MAJOR}.${tonetool_next_minor})

set(tonetool_program_file ${CMAKE_INSTALL_BINDIR}/tonetool${CMAKE_EXECUTABLE_SUFFIX})
configure_package_config_file(cmake/tonetoolConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/tonetoolConfig.cmake INSTALL_DESTINATION ${tonetool_package_dir}
  PATH_VARS tonetool_program_file)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/tonetoolConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
configure_file(cmake/tonetool.pc.in ${CMAKE_CURRENT_BINARY_DIR}/tonetool.pc @ONLY)

install(TARGETS tonetool EXPORT tonetoolTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT tonetoolTargets NAMESPACE tonetool:: DESTINATION ${tonetool_package_dir})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tonetoolConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/tonetoolConfigVersion.cmake
              cmake/OpenImageIOFolders.cmake cmake/tonetoolTests.cmake
        DESTINATION ${tonetool_package_dir})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tonetool.pc DESTINATION ${tonetool_pc_dir})
install(DIRECTORY include/tonetool ${TONETOOL_GENERATED}/tonetool
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
