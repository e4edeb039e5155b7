# SPDX-License-Identifier: MIT
# What tinylqg::design is built on: Eigen, Boost.Multiprecision, MPFR, GMP, threads. Those that are not found stand in
# LQG_DESIGN_MISSING. MPFR and GMP bring no targets: tinylqg_mpfr is theirs; a program with the property LQG_STATIC_MPFR
# gets their static libraries, where there are any.
if(POLICY CMP0167)
  cmake_policy(SET CMP0167 NEW)  # Boost is found by its own package
endif()
find_package(Eigen3 3.4 QUIET NO_MODULE)
find_package(Boost 1.74 QUIET)
find_package(Threads QUIET)
find_path(MPFR_INCLUDE_DIR mpfr.h)
find_library(MPFR_LIBRARY mpfr)
find_library(GMP_LIBRARY gmp)
find_library(MPFR_STATIC_LIBRARY libmpfr.a)
find_library(GMP_STATIC_LIBRARY libgmp.a)

set(LQG_DESIGN_MISSING)
foreach(need IN ITEMS Eigen3_FOUND Boost_FOUND Threads_FOUND MPFR_INCLUDE_DIR MPFR_LIBRARY GMP_LIBRARY)
  if(NOT ${need})
    string(REGEX REPLACE "_.*" "" package ${need})
    list(APPEND LQG_DESIGN_MISSING ${package})
  endif()
endforeach()
list(REMOVE_DUPLICATES LQG_DESIGN_MISSING)

if(NOT LQG_DESIGN_MISSING AND NOT TARGET tinylqg_mpfr)
  add_library(tinylqg_mpfr INTERFACE IMPORTED GLOBAL)
  set(LQG_IS_STATIC $<BOOL:$<TARGET_PROPERTY:LQG_STATIC_MPFR>>)
  set_target_properties(tinylqg_mpfr PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${MPFR_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "$<IF:${LQG_IS_STATIC},${MPFR_STATIC_LIBRARY},${MPFR_LIBRARY}>;\
$<IF:${LQG_IS_STATIC},${GMP_STATIC_LIBRARY},${GMP_LIBRARY}>")
endif()
