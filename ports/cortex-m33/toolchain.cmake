# SPDX-License-Identifier: MIT
# Cortex-M33 with its single-precision FPU, by GCC:
#     cmake --toolchain ports/cortex-m33/toolchain.cmake …
set(lqg_cpu "-mcpu=cortex-m33 -mfpu=fpv5-sp-d16 -mfloat-abi=hard")
set(lqg_machine mps2-an505)
set(lqg_uart 0x50200000u)
set(LQG_FUSED_REALS float)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../cortex-m/toolchain.cmake)
