# SPDX-License-Identifier: MIT
# cmake -DTOOL=<program> -DARGUMENTS=<list> -DHOME=<folder> -P run_tool.cmake: runs it with this home, or says that it
# is not found.
if(NOT EXISTS ${TOOL})
  message("Not found: ${TOOL}")
  return()
endif()
file(MAKE_DIRECTORY ${HOME})
set(ENV{HOME} ${HOME})
set(ENV{XDG_CACHE_HOME} ${HOME}/.cache)
set(ENV{XDG_CONFIG_HOME} ${HOME}/.config)
execute_process(COMMAND ${TOOL} ${ARGUMENTS} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${TOOL} ended with ${status}")
endif()
