/* SPDX-License-Identifier: MIT */
/* An Arduino Uno, simulated by libsimavr: runs a sketch's ELF file; what hangs on its pins is up to the caller. */
#ifndef UNO_H
#define UNO_H

#include <stddef.h>
#include <stdint.h>

typedef struct avr_t avr_t;

enum { UNO_CLOCK = 16000000 };

/* Ends the program with a message where the file is not an ELF file. */
avr_t *uno_load(const char *elf);

/* What the sketch has printed on its serial port so far. */
const char *uno_printed(void);

/* Runs until `seconds` have passed since the start; 0, or −1 when the core crashed. */
int uno_run_until(avr_t *avr, double seconds);

/* Level of a pin, 0 … 19, that the sketch drives; sets one that it reads, 0 … 13; sets an analog one, 0 … 5, in V. */
int uno_output(const avr_t *avr, int pin);
void uno_set_input(avr_t *avr, int pin, int level);
void uno_set_analog(avr_t *avr, int pin, double volts);

/* Duty of the PWM of pins 9 and 10 when the sketch runs timer 1 up to ICR1. */
double uno_duty(const avr_t *avr, int pin);

/* A device with registers of one byte on the I²C bus, as most sensors are: a write sets the address and may go on with
 * values, a read goes on from the address. A silent one does not answer. */
typedef struct {
    uint8_t address; /* 7 bits */
    uint8_t registers[256];
    int silent;
    uint8_t selected, has_pointer, pointer; /* of the transfer that is going on */
    struct avr_irq_t *irq;
} uno_i2c_device;

void uno_connect(avr_t *avr, uno_i2c_device *device);

#endif
