/* SPDX-License-Identifier: MIT */
/* What the examples need of a board besides start-up code; each family of ports has it in uart.c and counter.c. */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* A serial line of 8 bits, no parity, one stop bit; 115200 baud where the wire has a speed. */
void uart_start(void);

/* The next byte, or −1 while there is none. */
int uart_read(void);

/* Waits until the byte is on its way. */
void uart_write(uint8_t byte);

/* Ticks of a counter that runs upwards, once a cycle of the processor on a board; it wraps at COUNTER_MASK + 1. */
void counter_start(void);
uint32_t counter_now(void);
extern const uint32_t counter_mask;

/* Hz of the processor, 0 where it is emulated. */
extern const uint32_t counter_frequency;

/* Ends the program, the status being that of the emulator; of the start-up code. On a board without debugger it
 * stops. */
void board_leave(int status);

#endif
