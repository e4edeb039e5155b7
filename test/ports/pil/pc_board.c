/* SPDX-License-Identifier: MIT */
/* A board that is a program of the PC: the target's own text, its serial line being standard input and output. One byte
 * of what it says can be damaged on the way:
 *
 *     PIL_FAULT=flip:N   byte N has one bit wrong, and the counter stands still: what it measures may look like the
 *                        beginning of a frame, and a damaged frame with another one inside counts as two
 *     PIL_FAULT=drop:N   byte N is lost
 *     PIL_FAULT=junk:N   before byte N come others, the beginning of a frame among them
 *     PIL_FAULT=end:N    the board dies
 *     PIL_FAULT=deaf:N   byte N of what it hears is lost
 *     PIL_FAULT=hears:N  byte N of what it hears has one bit wrong
 *     PIL_FAULT=still:1  its counter stands still
 *     PIL_FAULT=dear:1   reading its counter is dear at first: the frame takes 100 ticks, a thousand instructions 1000
 *                        more, and every step with its frame 50 */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "board.h"

const uint32_t counter_mask = 0xFFFFFFFF;
const uint32_t counter_frequency = 0;

static char fault[16];
static unsigned long faulty = 0; /* counted from 1; 0: none */
static unsigned long said, heard;

void uart_start(void)
{
    const char *text = getenv("PIL_FAULT");

    if (text && sscanf(text, "%15[a-z]:%lu", fault, &faulty) != 2)
        exit(2);
}

static int happens(const char *what, unsigned long at)
{
    return at == faulty && strcmp(fault, what) == 0;
}

/* Waits, unlike a real one: there is nothing else to do. */
int uart_read(void)
{
    uint8_t byte;

    if (read(STDIN_FILENO, &byte, 1) != 1)
        exit(0);
    heard++;
    if (happens("hears", heard))
        return byte ^ 0x10;
    return happens("deaf", heard) ? -1 : byte;
}

static void put(const uint8_t *bytes, size_t count)
{
    if (write(STDOUT_FILENO, bytes, count) != (ssize_t)count)
        exit(1);
}

void uart_write(uint8_t byte)
{
    static const uint8_t junk[] = {0x00, 0xA5, 0xFF, 0xA5, 0x04, 0x08, 0x13};

    said++;
    if (happens("drop", said))
        return;
    if (happens("flip", said))
        byte ^= 0x10;
    if (happens("junk", said))
        put(junk, sizeof junk);
    if (happens("end", said))
        exit(7);
    put(&byte, 1);
}

void counter_start(void) {}

/* The target measures the frame first, then a thousand instructions, in 64 readings at most. */
static uint32_t dear_counter(void)
{
    static uint32_t now = 0;
    static unsigned readings = 0;

    readings++;
    now += readings == 2 ? 100 : readings <= 64 ? 1100 : 50;
    return now;
}

/* Nanoseconds. */
uint32_t counter_now(void)
{
    struct timespec now;

    if (happens("dear", 1))
        return dear_counter();
    if (happens("still", 1) || strcmp(fault, "flip") == 0)
        return 0;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)((uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec);
}
