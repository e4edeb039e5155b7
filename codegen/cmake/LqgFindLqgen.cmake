# SPDX-License-Identifier: MIT
# lqg_find_lqgen(<variable>): sets the variable to the lqgen to run: a path, or the generator expression of one that
# this build makes. It is the first of
#
#   LQG_LQGEN_EXECUTABLE   a variable of CMake: the path of an lqgen for the machine that builds
#   tinylqg::lqgen         the target, where this build makes it
#   LQGEN                  a variable of CMake or of the environment, a path as well
#   tinylqg::lqgen         the target of an installed TinyLQG
#   lqgen                  on the PATH, of the same version
#   TinyLQG's source tree  of which lqgen is built now, for the machine that builds, without this build's toolchain;
#                          once for a build folder, in lqgen_for_this_machine
include_guard(GLOBAL)

function(lqg_find_lqgen variable)
  set(found)
  if(NOT LQG_LQGEN_EXECUTABLE AND TARGET tinylqg::lqgen)
    get_target_property(is_imported tinylqg::lqgen IMPORTED)
    if(NOT is_imported)
      set(found $<TARGET_FILE:tinylqg::lqgen>)
    endif()
  endif()
  if(NOT found)
    lqg_find_named_lqgen(found)
  endif()
  if(NOT found AND TARGET tinylqg::lqgen)
    get_target_property(found tinylqg::lqgen LOCATION)
  endif()
  if(NOT found)
    lqg_find_lqgen_on_path(found)
  endif()
  if(NOT found)
    lqg_build_lqgen(found)
  endif()
  set(${variable} "${found}" PARENT_SCOPE)
endfunction()

# Sets `variable` to the lqgen that a variable names, to nothing where none does.
function(lqg_find_named_lqgen variable)
  set(named)
  if(LQG_LQGEN_EXECUTABLE)
    set(name LQG_LQGEN_EXECUTABLE)
    set(named "${LQG_LQGEN_EXECUTABLE}")
  elseif(LQGEN)
    set(name LQGEN)
    set(named "${LQGEN}")
  elseif(NOT "$ENV{LQGEN}" STREQUAL "")
    set(name "LQGEN in the environment")
    set(named "$ENV{LQGEN}")
  endif()
  if(named AND (NOT EXISTS "${named}" OR IS_DIRECTORY "${named}"))
    message(FATAL_ERROR "${name}: there is no ${named}; expected the path of an lqgen for the machine that builds")
  endif()
  set(${variable} "${named}" PARENT_SCOPE)
endfunction()

# Sets `variable` to the lqgen on the PATH, if it has the version of the headers: others refuse each other.
function(lqg_find_lqgen_on_path variable)
  set(${variable} "" PARENT_SCOPE)
  find_program(LQG_LQGEN_ON_PATH lqgen NO_CMAKE_FIND_ROOT_PATH)
  mark_as_advanced(LQG_LQGEN_ON_PATH)
  set(expected ${tinylqg_VERSION})
  lqg_source_tree(root)
  if(root)
    file(STRINGS ${root}/include/lqg/version.h lines REGEX "#define LQG_VERSION_(MAJOR|MINOR|PATCH) ")
    string(REGEX REPLACE "[^0-9;]" "" numbers "${lines}")
    string(REPLACE ";" "." expected "${numbers}")
  endif()
  if(LQG_LQGEN_ON_PATH)
    execute_process(COMMAND "${LQG_LQGEN_ON_PATH}" --version OUTPUT_VARIABLE version ERROR_QUIET)
    string(STRIP "${version}" version)
    if(version STREQUAL "${expected}")
      set(${variable} "${LQG_LQGEN_ON_PATH}" PARENT_SCOPE)
    endif()
  endif()
endfunction()

# Sets `variable` to the folder of TinyLQG's sources; to nothing in an installation.
function(lqg_source_tree variable)
  get_filename_component(root ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../.. ABSOLUTE)
  if(NOT EXISTS ${root}/codegen/lqgen.cpp)
    set(root)
  endif()
  set(${variable} "${root}" PARENT_SCOPE)
endfunction()

# Sets `variable` to an lqgen that is up to date with the sources, by the compiler that CMake finds for the machine that
# builds. A build system around this one, and its target, are kept from it.
function(lqg_build_lqgen variable)
  lqg_source_tree(root)
  if(NOT root)
    message(FATAL_ERROR "lqg_add_controller: there is no lqgen. Install TinyLQG with it (LQG_BUILD_CODEGEN=ON), put it "
                        "on the PATH, or set LQG_LQGEN_EXECUTABLE to an lqgen for this machine")
  endif()
  set(folder ${CMAKE_BINARY_DIR}/lqgen_for_this_machine)
  set(lqgen ${folder}/bin/lqgen${CMAKE_HOST_EXECUTABLE_SUFFIX})
  get_property(is_built GLOBAL PROPERTY lqgen_for_this_machine_is_built)
  if(NOT is_built)
    set_property(GLOBAL PROPERTY lqgen_for_this_machine_is_built TRUE)
    message(STATUS "Building lqgen for this machine "
                   "(a few minutes the first time; LQGEN=<path> names one that is there)")
    set(plain ${CMAKE_COMMAND} -E env --unset=MAKEFLAGS --unset=MFLAGS --unset=MAKELEVEL)
    if(CMAKE_CROSSCOMPILING)
      list(APPEND plain --unset=CMAKE_TOOLCHAIN_FILE --unset=CC --unset=CXX --unset=CPPFLAGS --unset=CFLAGS
                        --unset=CXXFLAGS --unset=LDFLAGS)
    endif()
    cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
    lqg_run_for_lqgen(${plain} ${CMAKE_COMMAND} -S ${root} -B ${folder} -G ${CMAKE_GENERATOR}
                      -DLQG_BUILD_CODEGEN=ON -DLQG_BUILD_TESTS=OFF -DCMAKE_BUILD_TYPE=Release
                      -DCMAKE_RUNTIME_OUTPUT_DIRECTORY_RELEASE=${folder}/bin)
    lqg_run_for_lqgen(${plain} ${CMAKE_COMMAND} --build ${folder} --config Release --target lqgen
                      --parallel ${processors})
  endif()
  set(${variable} ${lqgen} PARENT_SCOPE)
endfunction()

function(lqg_run_for_lqgen)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "lqg_add_controller: lqgen could not be built for this machine; the reason stands above. What "
                        "it needs is named by ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/setup.sh. "
                        "LQG_LQGEN_EXECUTABLE names an lqgen that is there")
  endif()
endfunction()
