# SPDX-License-Identifier: MIT
# Runs CONTRACTED and PLAIN, two builds of contraction.c: same hash, and only the first contracts what it may.
execute_process(COMMAND ${CONTRACTED} OUTPUT_VARIABLE contracted COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${PLAIN} OUTPUT_VARIABLE plain COMMAND_ERROR_IS_FATAL ANY)
message(STATUS "contraction allowed:\n${contracted}contraction off:\n${plain}")
if(NOT contracted MATCHES "^([0-9a-f]+)\ncontracted\n$")
  message(FATAL_ERROR "the first build does not contract anything: nothing was tested")
endif()
if(NOT plain STREQUAL "${CMAKE_MATCH_1}\nplain\n")
  message(FATAL_ERROR "the library's bits depend on -ffp-contract")
endif()
