# SPDX-License-Identifier: MIT
# Cortex-M0, as in the micro:bit, by GCC:
#     cmake --toolchain ports/cortex-m0/toolchain.cmake …
set(lqg_cpu "-mcpu=cortex-m0")
set(lqg_machine microbit)
set(lqg_hertz 16000000)
set(lqg_board ${CMAKE_CURRENT_LIST_DIR}/uart.c ${CMAKE_CURRENT_LIST_DIR}/counter.c)
set(LQG_FUSED_REALS)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../cortex-m/toolchain.cmake)
