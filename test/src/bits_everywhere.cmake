# SPDX-License-Identifier: MIT
# Builds print_bits.c and the library with COMPILER and many options: all of one variant print the same hash. Where
# the processor has fused multiply-adds, FMA is the option that allows them.
set(modes "-std=c99 -O0" "-std=c99 -Os" "-std=c99 -O3" "-std=gnu99 -O3 ${FMA}" "-std=gnu99 -O2 -flto ${FMA}"
          "-x c++ -O2 ${FMA}")
file(GLOB sources ${LIBRARY}/*.c)

foreach(definitions IN ITEMS "-DVARIANT=f32" "-DLQG_REAL_DOUBLE" "-DLQG_FUSED" "-DLQG_REAL_DOUBLE;-DLQG_FUSED")
  unset(first)
  foreach(mode IN LISTS modes)
    separate_arguments(options UNIX_COMMAND "${mode}")
    execute_process(COMMAND ${COMPILER} ${options} ${definitions} -I${INCLUDE} ${TESTS}/print_bits.c ${TESTS}/bits.c
                            ${sources} -lm -o ${WORK}/print_bits COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND ${WORK}/print_bits OUTPUT_VARIABLE hash COMMAND_ERROR_IS_FATAL ANY)
    if(NOT DEFINED first)
      set(first ${hash})
    endif()
    if(NOT hash STREQUAL first)
      message(FATAL_ERROR "${mode} ${definitions}: ${hash} and not ${first}")
    endif()
  endforeach()
endforeach()
