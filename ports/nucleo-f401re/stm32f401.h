/* SPDX-License-Identifier: MIT */
/* The registers of the STM32F401 that the examples use: ST, RM0368, "STM32F401xB/C and STM32F401xD/E reference manual";
 * the chapters are named. Other parts of the family F4 have them at the same places. */
#ifndef STM32F401_H
#define STM32F401_H

#include <stdint.h>

/* Chapter 6, reset and clock control: a bit switches a peripheral on. */
typedef struct {
    volatile uint32_t cr, pllcfgr, cfgr, cir, ahb1rstr, ahb2rstr, reserved_0[2], apb1rstr, apb2rstr, reserved_1[2],
        ahb1enr, ahb2enr, reserved_2[2], apb1enr, apb2enr;
} rcc_t;

#define RCC ((rcc_t *)0x40023800u)
enum { RCC_GPIOA = 1 << 0, RCC_GPIOB = 1 << 1 };                                         /* ahb1enr */
enum { RCC_TIM2 = 1 << 0, RCC_TIM3 = 1 << 1, RCC_USART2 = 1 << 17, RCC_I2C1 = 1 << 21 }; /* apb1enr */
enum { RCC_TIM1 = 1 << 0 };                                                              /* apb2enr */

/* Chapter 8, general-purpose inputs and outputs. */
typedef struct {
    volatile uint32_t moder, otyper, ospeedr, pupdr, idr, odr, bsrr, lckr, afr[2];
} gpio_t;

#define GPIOA ((gpio_t *)0x40020000u)
#define GPIOB ((gpio_t *)0x40020400u)
enum { GPIO_OUTPUT = 1, GPIO_ALTERNATE = 2 };

/* Chapter 12 (TIM1) and 13 (TIM2 to TIM5), timers. */
typedef struct {
    volatile uint32_t cr1, cr2, smcr, dier, sr, egr, ccmr1, ccmr2, ccer, cnt, psc, arr, rcr, ccr1, ccr2, ccr3, ccr4,
        bdtr;
} timer_t;

#define TIM1 ((timer_t *)0x40010000u)
#define TIM2 ((timer_t *)0x40000000u)
#define TIM3 ((timer_t *)0x40000400u)

/* Chapter 17, independent watchdog. */
typedef struct {
    volatile uint32_t kr, pr, rlr, sr;
} iwdg_t;

#define IWDG ((iwdg_t *)0x40003000u)
enum { IWDG_UNLOCK = 0x5555, IWDG_FEED = 0xAAAA, IWDG_START = 0xCCCC };

/* Chapter 18, I²C. */
typedef struct {
    volatile uint32_t cr1, cr2, oar1, oar2, dr, sr1, sr2, ccr, trise;
} i2c_t;

#define I2C1 ((i2c_t *)0x40005400u)
enum { I2C_PE = 1 << 0, I2C_START = 1 << 8, I2C_STOP = 1 << 9, I2C_ACK = 1 << 10, I2C_SWRST = 1 << 15 }; /* cr1 */
enum {
    I2C_SB = 1 << 0,
    I2C_ADDR = 1 << 1,
    I2C_BTF = 1 << 2,
    I2C_RXNE = 1 << 6,
    I2C_TXE = 1 << 7,
    I2C_AF = 1 << 10
}; /* sr1 */

/* Chapter 19, USART. */
typedef struct {
    volatile uint32_t sr, dr, brr, cr1, cr2, cr3;
} usart_t;

#define USART2 ((usart_t *)0x40004400u)
enum { USART_RXNE = 1 << 5, USART_TXE = 1 << 7 };                  /* sr */
enum { USART_RE = 1 << 2, USART_TE = 1 << 3, USART_UE = 1 << 13 }; /* cr1 */

/* A pin's mode (GPIO_…) and, where it is GPIO_ALTERNATE, its function. */
static inline void gpio_set_mode(gpio_t *port, unsigned pin, unsigned mode, unsigned function)
{
    port->afr[pin / 8] = (port->afr[pin / 8] & ~(0xFu << 4 * (pin % 8))) | function << 4 * (pin % 8);
    port->moder = (port->moder & ~(3u << 2 * pin)) | mode << 2 * pin;
}

static inline void gpio_write(gpio_t *port, unsigned pin, int high)
{
    port->bsrr = high ? 1u << pin : 1u << (pin + 16);
}

#endif
