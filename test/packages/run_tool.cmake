# cmake -DTOOL=<program> -DARGUMENTS=<list> -P run_tool.cmake: runs it, or says that it is not found.
if(NOT EXISTS ${TOOL})
  message("Not found: ${TOOL}")
  return()
endif()
execute_process(COMMAND ${TOOL} ${ARGUMENTS} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${TOOL} ended with ${status}")
endif()
