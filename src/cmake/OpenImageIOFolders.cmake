# SPDX-License-Identifier: BSD-3-Clause
# Debian's OpenImageIO target names include folders of packages that it does not depend on, and
# CMake refuses folders that are not there.
get_target_property(tonetool_oiio_folders OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
foreach(tonetool_folder IN LISTS tonetool_oiio_folders)
  if(NOT tonetool_folder MATCHES "^\\$<" AND NOT EXISTS "${tonetool_folder}")
    list(REMOVE_ITEM tonetool_oiio_folders "${tonetool_folder}")
  endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${tonetool_oiio_folders}")
unset(tonetool_oiio_folders)
unset(tonetool_folder)
