# SPDX-License-Identifier: MIT
# cmake -DFOLDER=… -DEXPECTED=… -P options.cmake -- <option>…: configures the project `options` with the options and
# builds it; it has to end in EXPECTED, or to succeed where that is empty.
include(${CMAKE_CURRENT_LIST_DIR}/arguments_after_dashes.cmake)
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/options -B ${FOLDER} ${options}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${FOLDER}
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT EXPECTED AND result EQUAL 0)
  return()
endif()
string(REGEX REPLACE "[ \n]+" " " line "${output}")  # CMake wraps its messages
if(NOT EXPECTED OR result EQUAL 0 OR NOT line MATCHES "${EXPECTED}")
  message(FATAL_ERROR "expected ${EXPECTED}, found a build that ended with ${result}:\n${output}")
endif()
