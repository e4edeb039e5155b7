# SPDX-License-Identifier: MIT
# cmake -DSTATUS=<exit status> -DTEXT=<regular expression> -DFAULT=<of pc_board.c> -P expect.cmake -- <command>…
# passes if the command ends with that status and has said that. With -DPROGRAM=<file> it says "Not found" where that is
# not there.
set(command)
set(is_command FALSE)
foreach(i RANGE 1 ${CMAKE_ARGC})
  if(is_command AND i LESS CMAKE_ARGC)
    list(APPEND command "${CMAKE_ARGV${i}}")
  elseif("${CMAKE_ARGV${i}}" STREQUAL "--")
    set(is_command TRUE)
  endif()
endforeach()

if(PROGRAM AND NOT EXISTS ${PROGRAM})
  message("Not found: ${PROGRAM}, which needs what could not be had here")
  return()
endif()
if(FAULT)
  set(ENV{PIL_FAULT} ${FAULT})
endif()
execute_process(COMMAND ${command} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said TIMEOUT 120)
message("${said}")
if(NOT status EQUAL STATUS)
  message(FATAL_ERROR "Expected exit status ${STATUS}, found ${status}")
endif()
if(NOT said MATCHES "${TEXT}")
  message(FATAL_ERROR "Expected text: ${TEXT}")
endif()
