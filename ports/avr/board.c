/* SPDX-License-Identifier: MIT */
/* An AVR without more around it: what the program prints goes out of UART 0 at 115200 baud, and so does the exit status
 * that main() returns, as the last line. Then the core sleeps with interrupts off, which ends a simulation.
 *
 * F_CPU is the clock in Hz, 16 MHz unless it is defined. */
#include <stdio.h>
#include <stdlib.h>

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

#ifndef F_CPU
#define F_CPU 16000000ul
#endif

static int send(char byte, FILE *stream)
{
    (void)stream;
    loop_until_bit_is_set(UCSR0A, UDRE0);
    UDR0 = (unsigned char)byte;
    return 0;
}

static FILE uart = FDEV_SETUP_STREAM(send, NULL, _FDEV_SETUP_WRITE);

/* Before main(). Bit time F_CPU/8/(UBRR0 + 1), rounded to the nearest. */
__attribute__((constructor)) static void start_uart(void)
{
    enum { BAUD = 14400 }; /* 115200/8: an int has 16 bits */

    UCSR0A = 1 << U2X0;
    UBRR0 = (unsigned)((F_CPU / 32 / BAUD + 1) / 2 - 1);
    UCSR0B = 1 << TXEN0;
    stdout = &uart;
}

/* In place of the C library's, which stops without a word. */
void exit(int status)
{
    printf("exit status %d\n", status);
    loop_until_bit_is_set(UCSR0A, UDRE0);
    cli();
    sleep_enable();
    for (;;)
        sleep_cpu();
}
