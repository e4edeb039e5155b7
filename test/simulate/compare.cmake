# SPDX-License-Identifier: MIT
# Records runs of a DESIGN in STYLE and REAL in FILE, and holds them against its CONTROLLER.
execute_process(COMMAND ${RECORD} ${DESIGN} ${STYLE} ${REAL} ${FILE} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "record_runs has failed: ${result}")
endif()
execute_process(COMMAND ${REPLAY} "${CONTROLLER}" ${FILE} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "what the simulation shows is not what is shipped")
endif()
