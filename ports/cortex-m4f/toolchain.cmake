# SPDX-License-Identifier: MIT
# Cortex-M4 with its single-precision FPU, by GCC:
#     cmake --toolchain ports/cortex-m4f/toolchain.cmake …
set(lqg_cpu "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard")
set(lqg_machine mps2-an386)
set(lqg_uart 0x40004000u)
set(LQG_FUSED_REALS float)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../cortex-m/toolchain.cmake)
