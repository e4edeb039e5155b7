# SPDX-License-Identifier: MIT
# cmake -DPC=<program for the PC> -DTARGET=<command that runs the target's>… -P compare.cmake: the two say the same but
# for lines with #.
foreach(where IN ITEMS PC TARGET)
  execute_process(COMMAND ${${where}} OUTPUT_VARIABLE said RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${where} ends with ${status}:\n${said}")
  endif()
  string(REGEX MATCHALL "#[^\n]*" remarks_${where} "${said}")
  string(REGEX REPLACE "#[^\n]*\n" "" said_${where} "${said}")
endforeach()
message("PC: ${remarks_PC}\ntarget: ${remarks_TARGET}")
if(NOT said_PC MATCHES "nan < nan" OR NOT said_PC STREQUAL said_TARGET)
  message(FATAL_ERROR "expected what the PC says:\n${said_PC}found:\n${said_TARGET}")
endif()
