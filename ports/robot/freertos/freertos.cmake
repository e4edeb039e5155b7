# SPDX-License-Identifier: MIT
# The robot as a task: the kernel's sources are compiled here with its own warnings, ours with all.
cmake_path(GET CMAKE_CURRENT_LIST_DIR FILENAME folder)
if(CMAKE_C_FLAGS MATCHES "fpv[45]")
  set(kernel_port ${FREERTOS_KERNEL}/portable/GCC/ARM_CM4F)
else()
  set(kernel_port ${FREERTOS_KERNEL}/portable/GCC/ARM_CM3)
endif()
if(NOT EXISTS ${FREERTOS_KERNEL}/tasks.c OR NOT EXISTS ${kernel_port}/port.c)
  message(FATAL_ERROR "FREERTOS_KERNEL: expected the kernel's folder with tasks.c and portable/GCC, "
                      "found ${FREERTOS_KERNEL}")
endif()

add_library(freertos STATIC ${FREERTOS_KERNEL}/tasks.c ${FREERTOS_KERNEL}/list.c ${kernel_port}/port.c)
target_include_directories(freertos SYSTEM PUBLIC ${FREERTOS_KERNEL}/include ${kernel_port})
target_include_directories(freertos PUBLIC ${CMAKE_CURRENT_LIST_DIR} ..)
target_compile_definitions(freertos PUBLIC ROBOT_CLOCK=${clock})

add_executable(robot_freertos ${folder}/main.c)
target_link_libraries(robot_freertos PRIVATE freertos robot_parts)
target_compile_options(robot_freertos PRIVATE ${strict})
lqg_finish_firmware(robot_freertos)
