/* SPDX-License-Identifier: MIT */
/* The UART of Arm's MPS2 and MPS3 boards, which QEMU's machines have: Arm, "Cortex-M System Design Kit", section 4.3.
 * LQG_UART is its address, from the port's toolchain file. */
#include "board.h"

typedef struct {
    volatile uint32_t data, state, control, interrupt, divisor;
} uart_t;

enum { TRANSMIT_FULL = 1 << 0, RECEIVE_FULL = 1 << 1 };     /* state */
enum { TRANSMIT_ENABLE = 1 << 0, RECEIVE_ENABLE = 1 << 1 }; /* control */
enum { CLOCK = 25000000, BAUD = 115200 };

static uart_t *const uart = (uart_t *)LQG_UART;

void uart_start(void)
{
    uart->divisor = CLOCK / BAUD;
    uart->control = TRANSMIT_ENABLE | RECEIVE_ENABLE;
}

int uart_read(void)
{
    return uart->state & RECEIVE_FULL ? (int)(uart->data & 0xFF) : -1;
}

void uart_write(uint8_t byte)
{
    while (uart->state & TRANSMIT_FULL)
        ;
    uart->data = byte;
}
