# SPDX-License-Identifier: MIT
# What the ports to RISC-V share. Each of them is a file that sets
#     lqg_cpu   the compiler's options for the instruction set and the calling convention
#     lqg_bits  32 or 64
#     lqg_port  its folder, where memory.ld is
# and includes this one:
#     cmake --toolchain ports/<port>/toolchain.cmake …
# Debian: gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf. Programs run in QEMU where that is installed
# (qemu-system-misc), and so do their tests.
set(lqg_shift 0)  # mcycle counts ns
include(${CMAKE_CURRENT_LIST_DIR}/../bare-metal.cmake)
set(CMAKE_SYSTEM_PROCESSOR riscv${lqg_bits})
set(CMAKE_C_COMPILER riscv64-unknown-elf-gcc)

set(LQG_STARTUP ${CMAKE_CURRENT_LIST_DIR}/startup.c)  # to be compiled into every program
set(LQG_BOARD ${CMAKE_CURRENT_LIST_DIR}/uart.c ${CMAKE_CURRENT_LIST_DIR}/counter.c)  # what serves ports/board.h,
set(LQG_BOARD_DEFINITIONS LQG_UART=0x10000000u LQG_FREQUENCY=0)                      # to be compiled with these
set(CMAKE_C_FLAGS_INIT "${lqg_cpu} -mcmodel=medany --specs=picolibc.specs -ffunction-sections -fdata-sections")
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "-nostartfiles -Wl,--gc-sections -L ${lqg_port} -T ${CMAKE_CURRENT_LIST_DIR}/link.ld")

find_program(LQG_QEMU_RISCV${lqg_bits} qemu-system-riscv${lqg_bits})
if(LQG_QEMU_RISCV${lqg_bits})
  set(CMAKE_CROSSCOMPILING_EMULATOR ${LQG_QEMU_RISCV${lqg_bits}} -machine virt -bios none ${lqg_semihosting})
  set(LQG_EMULATOR ${LQG_QEMU_RISCV${lqg_bits}} -machine virt -bios none ${lqg_serial})
endif()
