# SPDX-License-Identifier: MIT
# RV32IMAFC, with a single-precision FPU, by GCC:
#     cmake --toolchain ports/rv32f/toolchain.cmake …
set(lqg_cpu "-march=rv32imafc -mabi=ilp32f")
set(lqg_bits 32)
set(LQG_FUSED_REALS float)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../riscv/toolchain.cmake)
