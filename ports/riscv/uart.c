/* SPDX-License-Identifier: MIT */
/* A UART of the family NS16550, as QEMU's machine virt has: National Semiconductor, "PC16550D Universal Asynchronous
 * Receiver/Transmitter with FIFOs", section 8. Its registers are a byte apart here, on many boards four. LQG_UART is
 * its address, from the toolchain file. */
#include "board.h"

typedef struct {
    volatile uint8_t data, interrupts, fifo, line, modem, state;
} uart_t;

enum { EIGHT_BITS = 3, DIVISOR_ACCESS = 1 << 7 }; /* line */
enum { FIFO_ON = 1 << 0 };
enum { RECEIVED = 1 << 0, SEND_EMPTY = 1 << 5 }; /* state */
enum { CLOCK = 3686400, BAUD = 115200, DIVISOR = CLOCK / (16 * BAUD) };

static uart_t *const uart = (uart_t *)LQG_UART;

void uart_start(void)
{
    uart->line = EIGHT_BITS | DIVISOR_ACCESS;
    uart->data = DIVISOR & 0xFF;
    uart->interrupts = DIVISOR >> 8;
    uart->line = EIGHT_BITS;
    uart->fifo = FIFO_ON;
}

int uart_read(void)
{
    return uart->state & RECEIVED ? uart->data : -1;
}

void uart_write(uint8_t byte)
{
    while (!(uart->state & SEND_EMPTY))
        ;
    uart->data = byte;
}
