# SPDX-License-Identifier: MIT
# Nucleo-F401RE, by GCC:
#     cmake --toolchain ports/nucleo-f401re/toolchain.cmake …
set(lqg_cpu "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard")
set(lqg_machine netduinoplus2)  # an STM32F405, whose UART, timers and addresses are the same
set(lqg_unused_uarts -serial null)  # USART1
set(lqg_hertz 16000000)         # of the internal oscillator, as after reset
set(lqg_board ${CMAKE_CURRENT_LIST_DIR}/uart.c ${CMAKE_CURRENT_LIST_DIR}/../cortex-m/counter.c)
set(LQG_FUSED_REALS float)  # what the hardware multiplies and adds in one
set(lqg_port ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../cortex-m/toolchain.cmake)
