# SPDX-License-Identifier: MIT
# RV32IMAC, without FPU, by GCC:
#     cmake --toolchain ports/rv32/toolchain.cmake …
set(lqg_cpu "-march=rv32imac -mabi=ilp32")
set(lqg_bits 32)
set(LQG_FUSED_REALS)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../riscv/toolchain.cmake)
