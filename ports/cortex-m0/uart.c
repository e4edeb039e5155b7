/* SPDX-License-Identifier: MIT */
/* UART0 of the nRF51822, as on the micro:bit V1: Nordic, "nRF51 Series Reference Manual", chapter 29. The micro:bit's
 * interface chip is on P0.24 (out) and P0.25 (in), and is a serial port of the PC. */
#include "board.h"

#define UART 0x40002000u
#define REGISTER(offset) (*(volatile uint32_t *)(UART + (offset)))

#define START_RECEIVING REGISTER(0x000)
#define START_SENDING REGISTER(0x008)
#define RECEIVED REGISTER(0x108)
#define SENT REGISTER(0x11C)
#define ENABLE REGISTER(0x500)
#define PIN_OUT REGISTER(0x50C)
#define PIN_IN REGISTER(0x514)
#define RECEIVE_DATA REGISTER(0x518)
#define SEND_DATA REGISTER(0x51C)
#define BAUD_RATE REGISTER(0x524)

#define PORT_DIRECTION_OUT (*(volatile uint32_t *)0x50000518u) /* GPIO, DIRSET */
#define PORT_SET (*(volatile uint32_t *)0x50000508u)           /* GPIO, OUTSET */

enum { OUT = 24, IN = 25, ENABLED = 4, BAUD_115200 = 0x01D7E000 };

void uart_start(void)
{
    PORT_SET = 1u << OUT; /* the line is high when nobody speaks */
    PORT_DIRECTION_OUT = 1u << OUT;
    PIN_OUT = OUT;
    PIN_IN = IN;
    BAUD_RATE = BAUD_115200;
    ENABLE = ENABLED;
    START_SENDING = 1;
    START_RECEIVING = 1;
}

int uart_read(void)
{
    if (!RECEIVED)
        return -1;
    RECEIVED = 0;
    return (int)(RECEIVE_DATA & 0xFF);
}

void uart_write(uint8_t byte)
{
    SENT = 0;
    SEND_DATA = byte;
    while (!SENT)
        ;
}
