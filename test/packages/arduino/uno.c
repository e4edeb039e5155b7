/* SPDX-License-Identifier: MIT */
#include "uno.h"

#include <stdio.h>
#include <stdlib.h>

#include <simavr/avr_adc.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_twi.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>

/* Addresses of ATmega328P's registers in its data space. */
enum { PORTB = 0x25, PORTC = 0x28, PORTD = 0x2b, ICR1 = 0x86, OCR1A = 0x88, OCR1B = 0x8a };

static char printed[10000];
static size_t printed_length;

static void keep_character(avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)param;
    if (printed_length + 1 < sizeof printed && value != '\r')
        printed[printed_length++] = (char)value;
}

const char *uno_printed(void)
{
    return printed;
}

avr_t *uno_load(const char *elf)
{
    elf_firmware_t firmware = {0};
    avr_t *avr = avr_make_mcu_by_name("atmega328p");
    uint32_t flags = 0;

    if (!avr || elf_read_firmware(elf, &firmware) != 0) {
        fprintf(stderr, "%s: expected an ELF file for an ATmega328P\n", elf);
        exit(2);
    }
    avr_init(avr);
    avr->log = LOG_ERROR;
    avr->frequency = UNO_CLOCK;
    avr->vcc = avr->avcc = avr->aref = 5000;
    avr_load_firmware(avr, &firmware);
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags); /* nothing to the terminal, no waiting */
    avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), keep_character, NULL);
    return avr;
}

int uno_run_until(avr_t *avr, double seconds)
{
    const avr_cycle_count_t end = (avr_cycle_count_t)(seconds * (double)UNO_CLOCK);

    while (avr->cycle < end) {
        const int state = avr_run(avr);
        if (state == cpu_Crashed || state == cpu_Done)
            return -1;
    }
    return 0;
}

int uno_output(const avr_t *avr, int pin)
{
    const int port = pin < 8 ? PORTD : pin < 14 ? PORTB : PORTC, first = pin < 8 ? 0 : pin < 14 ? 8 : 14;

    return avr->data[port] >> (pin - first) & 1;
}

/* The level is also what the pin is pulled to from outside: without that simavr lets the sketch's pull-up win whenever
 * another pin of the port is written to. */
void uno_set_input(avr_t *avr, int pin, int level)
{
    static avr_ioport_external_t outside[2] = {{.name = 'D'}, {.name = 'B'}};
    avr_ioport_external_t *port = &outside[pin / 8];
    const unsigned bit = 1u << pin % 8;

    port->mask |= bit;
    port->value = level ? port->value | bit : port->value & ~bit;
    avr_ioctl(avr, AVR_IOCTL_IOPORT_SET_EXTERNAL(port->name), port);
    avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(port->name), IOPORT_IRQ_PIN0 + pin % 8), (uint32_t)level);
}

void uno_set_analog(avr_t *avr, int pin, double volts)
{
    avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0 + pin), (uint32_t)(volts * 1000.0));
}

static unsigned word_of(const avr_t *avr, int address)
{
    return avr->data[address] | (unsigned)avr->data[address + 1] << 8;
}

double uno_duty(const avr_t *avr, int pin)
{
    const unsigned top = word_of(avr, ICR1);

    return top ? (double)word_of(avr, pin == 9 ? OCR1A : OCR1B) / top : 0.0;
}

static void acknowledge(uno_i2c_device *device)
{
    avr_raise_irq(device->irq + TWI_IRQ_INPUT, avr_twi_irq_msg(TWI_COND_ACK, device->selected, 1));
}

static void follow_bus(avr_irq_t *irq, uint32_t value, void *param)
{
    uno_i2c_device *device = (uno_i2c_device *)param;
    avr_twi_msg_irq_t message;

    (void)irq;
    message.u.v = value;
    if (message.u.twi.msg & (TWI_COND_STOP | TWI_COND_START))
        device->selected = 0;
    if (message.u.twi.msg & TWI_COND_START && message.u.twi.addr >> 1 == device->address && !device->silent) {
        device->selected = message.u.twi.addr;
        device->has_pointer = 0;
        acknowledge(device);
    }
    if (!device->selected)
        return;
    if (message.u.twi.msg & TWI_COND_WRITE) {
        acknowledge(device);
        if (device->has_pointer)
            device->registers[device->pointer++] = message.u.twi.data;
        else
            device->pointer = message.u.twi.data;
        device->has_pointer = 1;
    }
    if (message.u.twi.msg & TWI_COND_READ)
        avr_raise_irq(device->irq + TWI_IRQ_INPUT,
                      avr_twi_irq_msg(TWI_COND_READ, device->selected, device->registers[device->pointer++]));
}

void uno_connect(avr_t *avr, uno_i2c_device *device)
{
    static const char *names[] = {"8>device.in", "32<device.out"};

    device->irq = avr_alloc_irq(&avr->irq_pool, 0, 2, names);
    avr_irq_register_notify(device->irq + TWI_IRQ_OUTPUT, follow_bus, device);
    avr_connect_irq(device->irq + TWI_IRQ_INPUT, avr_io_getirq(avr, AVR_IOCTL_TWI_GETIRQ(0), TWI_IRQ_INPUT));
    avr_connect_irq(avr_io_getirq(avr, AVR_IOCTL_TWI_GETIRQ(0), TWI_IRQ_OUTPUT), device->irq + TWI_IRQ_OUTPUT);
}
