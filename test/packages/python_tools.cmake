# SPDX-License-Identifier: MIT
# cmake -DPYTHON=… -DFOLDER=… -DREQUIREMENTS=… -P python_tools.cmake: installs the requirements into a virtual
# environment; once is enough.
if(NOT PYTHON)
  message("Not found: python3")
  return()
endif()
file(SHA256 ${REQUIREMENTS} wanted)
set(stamp ${FOLDER}/installed)
if(EXISTS ${stamp})
  file(READ ${stamp} installed)
  if(installed STREQUAL wanted)
    return()
  endif()
endif()

execute_process(COMMAND ${PYTHON} -m venv --clear ${FOLDER}
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT failed)
  execute_process(COMMAND ${FOLDER}/bin/pip --quiet --disable-pip-version-check install --requirement ${REQUIREMENTS}
                  RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
endif()
if(failed)
  file(REMOVE_RECURSE ${FOLDER})
  message("Not found: pip could not install the tools:\n${said}")
  return()
endif()
file(WRITE ${stamp} ${wanted})
