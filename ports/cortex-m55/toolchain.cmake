# SPDX-License-Identifier: MIT
# Cortex-M55 with Helium and FPU, by GCC:
#     cmake --toolchain ports/cortex-m55/toolchain.cmake …
set(lqg_cpu "-mcpu=cortex-m55 -mfloat-abi=hard")
set(lqg_machine mps3-an547)
set(lqg_uart 0x59303000u)
set(LQG_FUSED_REALS float double)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../cortex-m/toolchain.cmake)
