# SPDX-License-Identifier: MIT
# AVR, by avr-gcc:
#     cmake --toolchain ports/avr/toolchain.cmake -DLQG_AVR_MCU=atmega328p …
# Debian: gcc-avr avr-libc. Programs run in simavr where that is installed, and so do their tests.
set(LQG_AVR_MCU atmega1284p CACHE STRING "the part: atmega328p (Uno, Nano), atmega2560 (Mega), …")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES LQG_AVR_MCU)
include(${CMAKE_CURRENT_LIST_DIR}/../bare-metal.cmake)
set(CMAKE_SYSTEM_PROCESSOR avr)
set(CMAKE_C_COMPILER avr-gcc)
set(LQG_REALS float)      # avr-gcc's double has 32 bits
set(LQG_FUSED_REALS)      # what the hardware multiplies and adds in one

set(LQG_STARTUP ${CMAKE_CURRENT_LIST_DIR}/board.c)  # to be compiled into every program
set(CMAKE_C_FLAGS_INIT "-mmcu=${LQG_AVR_MCU} -ffunction-sections -fdata-sections")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,--gc-sections")

find_program(LQG_SIMAVR simavr)
if(LQG_SIMAVR)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/run.sh ${LQG_AVR_MCU})
endif()
