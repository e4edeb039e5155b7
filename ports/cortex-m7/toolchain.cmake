# SPDX-License-Identifier: MIT
# Cortex-M7 with an FPU for both precisions, by GCC:
#     cmake --toolchain ports/cortex-m7/toolchain.cmake …
set(lqg_cpu "-mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard")
set(lqg_machine mps2-an500)
set(lqg_uart 0x40004000u)
set(LQG_FUSED_REALS float double)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../cortex-m/toolchain.cmake)
