# SPDX-License-Identifier: MIT
# cmake -DFOLDER=… -DDESIGN=… -DLQGEN=… -DTINYLQG=… -P rebuild.cmake: the header is made again when the design
# or lqgen has changed, and only then; a changed name gives a header of that name.

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}:\n${output}")
  endif()
endfunction()

function(build)
  run(${CMAKE_COMMAND} -E sleep 1)  # file times of a whole second must tell before from after
  run(${CMAKE_COMMAND} --build ${FOLDER}/build)
endfunction()

function(expect_time_changed file before expected why)
  file(TIMESTAMP ${file} now "%s")
  if(now STREQUAL before)
    set(changed FALSE)
  else()
    set(changed TRUE)
  endif()
  if(NOT changed STREQUAL expected)
    message(FATAL_ERROR "${why}: made again is ${changed}, expected ${expected}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(COPY ${DESIGN} DESTINATION ${FOLDER})
get_filename_component(design ${DESIGN} NAME)
set(design ${FOLDER}/${design})
configure_file(${LQGEN} ${FOLDER}/lqgen COPYONLY)
file(WRITE ${FOLDER}/CMakeLists.txt "
cmake_minimum_required(VERSION 3.22)
project(rebuild LANGUAGES NONE)
include(${TINYLQG}/codegen/cmake/LqgAddController.cmake)
add_library(tinylqg::headers INTERFACE IMPORTED)
add_library(firmware INTERFACE)
lqg_add_controller(firmware ${design} STYLE unrolled OUTPUT_DIR generated)
add_custom_target(image ALL)
add_dependencies(image firmware)
")
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${FOLDER} -B ${FOLDER}/build -DLQG_LQGEN_EXECUTABLE=${FOLDER}/lqgen)

build()
set(header ${FOLDER}/build/generated/double_integrator.h)
file(TIMESTAMP ${header} first "%s")
build()
expect_time_changed(${header} "${first}" FALSE "nothing changed")

file(TOUCH ${FOLDER}/lqgen)
build()
expect_time_changed(${header} "${first}" TRUE "lqgen changed")

file(TIMESTAMP ${header} second "%s")
file(APPEND ${design} "# another line\n")
build()
expect_time_changed(${header} "${second}" TRUE "the design changed")

file(READ ${design} text)
string(REPLACE "\"double_integrator\"" "\"renamed\"" text "${text}")
file(WRITE ${design} "${text}")
build()
if(NOT EXISTS ${FOLDER}/build/generated/renamed.h)
  message(FATAL_ERROR "the design's name changed: there is no renamed.h")
endif()
