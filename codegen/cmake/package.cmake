# SPDX-License-Identifier: MIT
# `cpack -G DEB` in a configured build folder makes a Debian package of what `cmake --install` brings. A project around
# this one packs itself.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tinylqg)
set(CPACK_PACKAGE_VENDOR "TinyLQG contributors")
set(CPACK_PACKAGE_CONTACT "TinyLQG contributors <contributors@tinylqg.invalid>" CACHE STRING
    "Maintainer of the package: name and address of who publishes it")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "LQR, Kalman filters and LQG from a design file to C99")
set(CPACK_PACKAGE_DESCRIPTION
"lqgen reads a plant model and a few weights from a TOML file, designs a linear
quadratic regulator, a Kalman filter, or the two together (LQG) in 50 digits
and more, and writes a C99 header that runs the controller on a
microcontroller: straight-line code without heap, globals or libm.
The package has lqgen, the C library for controllers in compact form and for
matrices of one's own, the design engine as a C++ library, and the CMake
package that makes a controller's header part of a firmware's build.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_TINYLQG_CHANGELOG ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
set(CPACK_PACKAGE_CHECKSUM SHA256)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For firmware in a CMake project; for tinylqg::design.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS cmake)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libeigen3-dev, libboost-dev, libmpfr-dev")
include(CPack)
