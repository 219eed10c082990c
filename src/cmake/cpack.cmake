# SPDX-License-Identifier: BSD-3-Clause
# Packages: "cpack -G DEB" and "cpack -G RPM" in a build folder of the preset "package", which has
# Debian's folders. src/scripts/package.sh builds the .deb and tries it.
option(TONETOOL_DEBIAN "Install the changelog and the copyright file of a Debian package" OFF)
set(TONETOOL_PACKAGER "The tonetool authors <tonetool@localhost>" CACHE STRING
  "Who answers for the packages, as \"Name <address>\"")

set(CPACK_PACKAGE_NAME tonetool)
set(CPACK_PACKAGE_VENDOR "The tonetool authors")
set(CPACK_PACKAGE_CONTACT "${TONETOOL_PACKAGER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION "HDR-FLIP compares a render with a reference: one error map, one number and
an exit status, for any exposure that a viewer may pick. Tone curves and
OpenColorIO views show HDR pictures on a display. The command line is
that of oiiotool. The package holds the program, the library with its
headers, the Python module, the OpenImageIO plugin that reads recipes, and
tonetool-slurm.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_GENERATOR DEB)

# ~deb12 before ~deb13: who upgrades the system gets the package of the new one.
set(suite "")
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release release REGEX "^(ID|VERSION_ID|VERSION_CODENAME)=")
  string(REGEX MATCH "(^|;)VERSION_ID=\"?([0-9.]+)" found "${release}")
  set(suite "~deb${CMAKE_MATCH_2}")
  if(NOT found)
    set(suite "~sid")
  endif()
endif()
set(debian_version ${PROJECT_VERSION}-1${suite})
set(debian_dir ${PROJECT_BINARY_DIR}/debian)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1${suite})
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS python3)
if(TONETOOL_BUILD_PYTHON)
  # The module is of one version of Python.
  execute_process(COMMAND ${TONETOOL_PYTHON_EXECUTABLE} -c
    "import sys; a, b = sys.version_info[:2]; print(f'python3 (>= {a}.{b}), python3 (<< {a}.{b + 1})')"
    OUTPUT_VARIABLE CPACK_DEBIAN_PACKAGE_DEPENDS OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
endif()
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-numpy, python3-openimageio, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "openimageio-tools, libopenimageio-dev, libimath-dev, bash-completion, slurm-client")

# Maintainer scripts, changelog and copyright, as Debian wants them.
string(TIMESTAMP debian_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(plugin_folder ${CMAKE_INSTALL_PREFIX}/${TONETOOL_PLUGIN_DIR})
foreach(script IN ITEMS postinst prerm)
  configure_file(cmake/debian/${script}.in ${debian_dir}/${script} @ONLY FILE_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach()
file(WRITE ${debian_dir}/triggers "activate-noawait ldconfig\n")
set(so_version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
file(WRITE ${debian_dir}/shlibs "libtonetool ${so_version} tonetool (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${debian_dir}/postinst ${debian_dir}/prerm ${debian_dir}/triggers ${debian_dir}/shlibs)
if(TONETOOL_DEBIAN)
  file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
  # Debian has the text of the Apache License itself, which is the last on the page.
  file(READ ${PROJECT_SOURCE_DIR}/src/THIRD_PARTY.md third_party)
  string(REGEX REPLACE "```text\n +Apache License\n.*" "/usr/share/common-licenses/Apache-2.0\n"
    third_party "${third_party}")
  configure_file(cmake/debian/copyright.in ${debian_dir}/copyright @ONLY)
  configure_file(cmake/debian/changelog.in ${debian_dir}/changelog.Debian @ONLY)
  configure_file(${PROJECT_SOURCE_DIR}/src/CHANGELOG.md ${debian_dir}/changelog COPYONLY)
  execute_process(COMMAND gzip -9nfk ${debian_dir}/changelog ${debian_dir}/changelog.Debian
    COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${debian_dir}/copyright ${debian_dir}/changelog.gz ${debian_dir}/changelog.Debian.gz
    DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()

set(CPACK_RPM_PACKAGE_LICENSE "BSD-3-Clause")
set(CPACK_RPM_PACKAGE_GROUP "Applications/Multimedia")
set(CPACK_RPM_FILE_NAME RPM-DEFAULT)
set(CPACK_RPM_PACKAGE_REQUIRES "python3")
set(CPACK_RPM_PACKAGE_SUGGESTS "python3-numpy, python3-openimageio")
set(CPACK_RPM_SPEC_MORE_DEFINE "%define _build_id_links none")
set(CPACK_RPM_EXCLUDE_FROM_AUTO_FILELIST_ADDITION
  /usr/share/man /usr/share/man/man1 /usr/share/bash-completion
  /usr/share/bash-completion/completions /usr/share/zsh /usr/share/zsh/site-functions
  /usr/share/fish /usr/share/fish/vendor_completions.d)

include(CPack)
