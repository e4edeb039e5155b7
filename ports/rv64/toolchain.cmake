# SPDX-License-Identifier: MIT
# RV64GC, with an FPU for both precisions, by GCC:
#     cmake --toolchain ports/rv64/toolchain.cmake …
set(lqg_cpu "-march=rv64imafdc -mabi=lp64d")
set(lqg_bits 64)
set(LQG_FUSED_REALS float double)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../riscv/toolchain.cmake)
