# SPDX-License-Identifier: MIT
# Builds the controllers in CONTROLLERS and the library of ROOT with COMPILER and OPTIONS in WORK, adds LINK_OPTIONS to
# link them, by LINKER if that is another, and compares their bits with HASHES: EMULATOR, KINDS and CONTRACTS are those
# of compare.cmake.
if(NOT KINDS)
  set(KINDS "plain_float|plain_double|fused_float|fused_double")
endif()
separate_arguments(options UNIX_COMMAND "${OPTIONS}")
separate_arguments(link_options UNIX_COMMAND "${LINK_OPTIONS}")
file(REMOVE_RECURSE ${WORK})
file(GLOB library ${ROOT}/src/*.c)
list(FILTER library EXCLUDE REGEX "/(ekf|rls|status)\\.c$")  # lqgen calls none of them

# compile(<folder> <source or definition>…)
function(compile folder)
  file(MAKE_DIRECTORY ${WORK}/${folder})
  execute_process(COMMAND ${COMPILER} ${options} -w -I${ROOT}/include -I${ROOT}/test/bits -I${ROOT}/test/src
                          -I${CONTROLLERS} -c ${ARGN}
                  WORKING_DIRECTORY ${WORK}/${folder} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(definitions)
string(REPLACE "|" ";" kinds "${KINDS}")
foreach(kind IN LISTS kinds)
  list(APPEND definitions -DWITH_${kind})
  string(REGEX MATCH "^([a-z]*)_([a-z]*)$" found ${kind})
  set(variant)
  if(CMAKE_MATCH_1 STREQUAL "fused")
    list(APPEND variant -DLQG_FUSED)
  endif()
  if(CMAKE_MATCH_2 STREQUAL "double")
    list(APPEND variant -DLQG_REAL_DOUBLE)
  endif()
  compile(library_${kind} ${variant} ${library})
  compile(${kind} ${CONTROLLERS}/${CMAKE_MATCH_1}_unrolled_${CMAKE_MATCH_2}.c
                  ${CONTROLLERS}/${CMAKE_MATCH_1}_compact_${CMAKE_MATCH_2}.c)
endforeach()
compile(main ${definitions} ${ROOT}/test/bits/main.c)
file(GLOB objects ${WORK}/*/*.o)
if(NOT LINKER)
  list(REMOVE_ITEM options -x c++)
  set(LINKER ${COMPILER} ${options})
endif()
execute_process(COMMAND ${LINKER} ${objects} ${link_options} -lm -o ${WORK}/bits COMMAND_ERROR_IS_FATAL ANY)

set(PROGRAM ${WORK}/bits)
set(BUILD "${COMPILER} ${OPTIONS}")
include(${CMAKE_CURRENT_LIST_DIR}/compare.cmake)
