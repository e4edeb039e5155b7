/* SPDX-License-Identifier: MIT */
/* The line to the target: a serial port, or the standard input and output of a program that is the target. */
#ifndef LINE_H
#define LINE_H

#include <stdint.h>
#include <sys/types.h>

typedef struct {
    int file;      /* −1: closed */
    pid_t program; /* 0: there is none */
} line_t;

/* Both return 0, or −1 after saying why on standard error. */
int line_open(line_t *line, const char *device, unsigned long baud);
int line_start(line_t *line, char *const command[]);

/* Returns 0, or −1: the line is broken. */
int line_write(line_t *line, const uint8_t *bytes, unsigned count);

typedef enum { LINE_BYTE, LINE_TIMEOUT, LINE_BROKEN } line_result;

/* Waits for a byte. */
line_result line_read(line_t *line, uint8_t *byte, double seconds);

/* Ends the program, if there is one. */
void line_close(line_t *line);

/* Of a clock that only goes forward. */
double line_seconds(void);

#endif
