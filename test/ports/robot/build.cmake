# SPDX-License-Identifier: MIT
# cmake -DROBOT=… -DPORTS=… -DPORT=… -DFOLDER=… -DCONTROLLER=… -DKERNEL_FOLDER=… -P build.cmake
# compiles the robot's firmware for a port; as a task of FreeRTOS, too, where its kernel can be had.
execute_process(COMMAND ${ROBOT}/freertos/fetch.sh ${KERNEL_FOLDER}
                RESULT_VARIABLE status OUTPUT_VARIABLE kernel OUTPUT_STRIP_TRAILING_WHITESPACE)
if(status EQUAL 3)
  set(kernel "")
elseif(status)
  message(FATAL_ERROR "fetch.sh has failed: ${status}")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} --toolchain ${PORTS}/${PORT}/toolchain.cmake -S ${ROBOT} -B ${FOLDER}
                        -DCONTROLLER=${CONTROLLER} -DFREERTOS_KERNEL=${kernel}
                RESULT_VARIABLE status)
if(NOT status)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${FOLDER} RESULT_VARIABLE status)
endif()
if(status)
  message(FATAL_ERROR "The firmware cannot be built")
endif()
