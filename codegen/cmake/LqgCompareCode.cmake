# SPDX-License-Identifier: MIT
# cmake -DTARGET=… -DGIVEN=… -DSTRICT=… -P LqgCompareCode.cmake: fails if the two files are not the same.
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${GIVEN} ${STRICT}
                RESULT_VARIABLE different OUTPUT_QUIET ERROR_QUIET)
if(different)
  message(FATAL_ERROR "TinyLQG: with the options of ${TARGET} the compiler changes arithmetic, so that bits or NaNs "
                      "are lost. Leave out -ffast-math, -funsafe-math-optimizations, -fno-honor-nans, "
                      "-ffp-contract=fast and their like, or end with -fno-fast-math -ffp-contract=off.\n"
                      "Expected ${STRICT}\n   found ${GIVEN}")
endif()
