# SPDX-License-Identifier: MIT
# Cortex-M3, by GCC:
#     cmake --toolchain ports/cortex-m3/toolchain.cmake …
set(lqg_cpu "-mcpu=cortex-m3")
set(lqg_machine mps2-an385)
set(lqg_uart 0x40004000u)
set(LQG_FUSED_REALS)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../cortex-m/toolchain.cmake)
