/* SPDX-License-Identifier: MIT */
#include "report.h"

#include "board.h"

static const float wheel_radius = 0.04f; /* m */

void report_text(const char *text)
{
    while (*text)
        uart_write((uint8_t)*text++);
}

static void write_digits(unsigned long number)
{
    if (number >= 10)
        write_digits(number / 10);
    uart_write((uint8_t)('0' + number % 10));
}

void report_number(const char *name, long number)
{
    report_text(name);
    if (number < 0)
        uart_write('-');
    write_digits(number < 0 ? 0ul - (unsigned long)number : (unsigned long)number);
}

/* In thousandths. */
static void report_small(const char *name, float value)
{
    if (value - value == 0.0f) {
        report_number(name, (long)(1e3f * value));
    } else {
        report_text(name);
        report_text("?");
    }
}

void report_balancer(const balancer_t *balancer)
{
    const int balances = balancer->state == BALANCER_BALANCING;

    report_text(balancer_text(balancer));
    report_small("  pitch ", balances ? balancer->loop.x[BALANCING_ROBOT_X_PITCH] : balancer->sensors.tilt);
    report_small(" mrad  left ", wheel_radius * balancer->sensors.left);
    report_small(" mm  right ", wheel_radius * balancer->sensors.right);
    report_small(" mm  voltage ", balancer->voltage);
    report_number(" mV  samples ", (long)balancer->samples);
    report_number("  overruns ", (long)balancer->overruns);
    report_text("\r\n");
}
