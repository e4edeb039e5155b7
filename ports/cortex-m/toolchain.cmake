# SPDX-License-Identifier: MIT
# What the ports to Cortex-M share. Each of them is a file that sets
#     lqg_cpu      the compiler's options for core and FPU
#     lqg_machine  the machine of QEMU that has this core
#     lqg_port     its folder, where memory.ld is
#     lqg_uart     the address of its UART, of Arm's design kit; another UART: lqg_board, the files that serve it and a
#                  counter
#     lqg_hertz    of the real processor that the same program is for, if there is one
# and includes this one:
#     cmake --toolchain ports/<port>/toolchain.cmake …
# Debian: gcc-arm-none-eabi libnewlib-arm-none-eabi. Programs run in QEMU where that is installed
# (qemu-system-arm), and so do their tests.
set(lqg_shift 8)  # 256 ns: more than a tick of any machine's SysTick
include(${CMAKE_CURRENT_LIST_DIR}/../bare-metal.cmake)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)

set(LQG_STARTUP ${CMAKE_CURRENT_LIST_DIR}/startup.c)  # to be compiled into every program
if(NOT lqg_hertz)
  set(lqg_hertz 0)  # emulated
endif()
if(NOT lqg_board)
  set(lqg_board ${CMAKE_CURRENT_LIST_DIR}/uart.c ${CMAKE_CURRENT_LIST_DIR}/counter.c)
endif()
set(LQG_BOARD ${lqg_board})  # what serves ports/board.h, to be compiled with these definitions
set(LQG_BOARD_DEFINITIONS LQG_UART=${lqg_uart} LQG_FREQUENCY=${lqg_hertz})
set(CMAKE_C_FLAGS_INIT "${lqg_cpu} -mthumb -ffunction-sections -fdata-sections")
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "-nostartfiles --specs=nano.specs -Wl,--gc-sections -L ${lqg_port} -T ${CMAKE_CURRENT_LIST_DIR}/link.ld")

find_program(LQG_QEMU_ARM qemu-system-arm)
if(LQG_QEMU_ARM)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${LQG_QEMU_ARM} -machine ${lqg_machine} ${lqg_semihosting})
  set(LQG_EMULATOR ${LQG_QEMU_ARM} -machine ${lqg_machine} ${lqg_serial})
endif()
