/* SPDX-License-Identifier: MIT */
/* USART2 on PA2 and PA3: the board's ST-Link makes of it a serial port of the PC. */
#include "board.h"
#include "stm32f401.h"

enum { CLOCK = LQG_FREQUENCY, BAUD = 115200, DIVISOR = (CLOCK + BAUD / 2) / BAUD };
enum { TX = 2, RX = 3, USART2_FUNCTION = 7 };

void uart_start(void)
{
    RCC->ahb1enr |= RCC_GPIOA;
    RCC->apb1enr |= RCC_USART2;
    gpio_set_mode(GPIOA, TX, GPIO_ALTERNATE, USART2_FUNCTION);
    gpio_set_mode(GPIOA, RX, GPIO_ALTERNATE, USART2_FUNCTION);
    USART2->brr = DIVISOR;
    USART2->cr1 = USART_UE | USART_TE | USART_RE;
}

int uart_read(void)
{
    return USART2->sr & USART_RXNE ? (int)(USART2->dr & 0xFF) : -1;
}

void uart_write(uint8_t byte)
{
    while (!(USART2->sr & USART_TXE))
        ;
    USART2->dr = byte;
}
