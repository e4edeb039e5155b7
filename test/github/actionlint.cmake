# SPDX-License-Identifier: MIT
# cmake -DGO=<go> -DPROGRAM=<file> -P actionlint.cmake: builds the actionlint of go.mod, checked by the hashes of
# go.sum. Go itself knows whether it has built it already.
if(NOT GO)
  message("Not found: go, and no actionlint on the PATH")
  return()
endif()
set(package github.com/rhysd/actionlint/cmd/actionlint)
execute_process(COMMAND ${GO} build -mod=readonly -buildvcs=false -o ${PROGRAM} ${package}
                WORKING_DIRECTORY ${CMAKE_CURRENT_LIST_DIR}
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed)
  file(REMOVE ${PROGRAM})
  message("Not found: go could not build actionlint:\n${said}")
endif()
