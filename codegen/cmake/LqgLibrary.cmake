# SPDX-License-Identifier: MIT
# lqg_add_libraries(<folder of sources> <folder of headers>): the C99 library, one list of sources, four variants by the
# two options of lqg/arithmetic.h: tinylqg::tinylqg, double, fused and double_fused; two where the compiler's double has
# less than 64 bits, as avr-gcc's. `lqg_libraries` has the targets. Unless LQG_INSTALL is set, they are compiled only if
# something links them.
include_guard(GLOBAL)
include(CheckTypeSize)
include(GNUInstallDirs)

function(lqg_add_libraries sources headers)
  set(lqg_libraries)
  lqg_add_library(tinylqg              tinylqg)
  lqg_add_library(tinylqg_fused        fused        LQG_FUSED)
  check_type_size(double LQG_SIZE_OF_DOUBLE BUILTIN_TYPES_ONLY LANGUAGE C)
  if(NOT LQG_SIZE_OF_DOUBLE LESS 8)
    lqg_add_library(tinylqg_double       double       LQG_REAL_DOUBLE)
    lqg_add_library(tinylqg_double_fused double_fused LQG_REAL_DOUBLE LQG_FUSED)
  endif()
  set(lqg_libraries ${lqg_libraries} PARENT_SCOPE)
endfunction()

# Builds `target`, known as tinylqg::`name`; the definitions reach whoever links it.
function(lqg_add_library target name)
  set(only_if_linked EXCLUDE_FROM_ALL)
  if(LQG_INSTALL)
    set(only_if_linked)
  endif()
  file(GLOB files CONFIGURE_DEPENDS ${sources}/*.c)
  add_library(${target} STATIC ${only_if_linked} ${files})
  add_library(tinylqg::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} C_EXTENSIONS OFF)
  target_compile_features(${target} PUBLIC c_std_99)
  target_compile_definitions(${target} PUBLIC ${ARGN})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${headers}>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  if((UNIX OR CMAKE_SYSTEM_NAME STREQUAL "Generic") AND "LQG_FUSED" IN_LIST ARGN)
    target_link_libraries(${target} PUBLIC m)
  endif()
  set(lqg_libraries ${lqg_libraries} ${target} PARENT_SCOPE)
endfunction()
