/* SPDX-License-Identifier: MIT */
#include "timing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const titles[TIMING_ROWS] = {"update", "control", "predict", "all three", "round trip, µs"};

enum { CYCLES_MAX = 8 }; /* that a real processor takes to do nothing; a counter that is faster is an emulator's */

/* On a board a tick is a cycle. An emulator's counter that stands still for a thousand instructions says nothing of
 * one. */
static void choose_unit(timing_t *timing, const pil_hello_t *hello, int emulated)
{
    timing->frequency = emulated || hello->ticks_of_thousand > 1000 * CYCLES_MAX ? 0.0 : hello->frequency;
    timing->ticks_of_unit = 1.0;
    timing->unit = timing->frequency > 0.0 ? "cycles" : "ticks";
    if (timing->frequency > 0.0 || hello->ticks_of_thousand == 0)
        return;
    timing->ticks_of_unit = hello->ticks_of_thousand / 1000.0;
    timing->unit = "instructions";
}

int timing_start(timing_t *timing, unsigned count, const pil_hello_t *hello, int emulated)
{
    timing->count = count;
    choose_unit(timing, hello, emulated);
    for (int row = 0; row < TIMING_ROWS; row++) {
        timing->rows[row] = calloc(count, sizeof timing->rows[row][0]);
        if (!timing->rows[row])
            return -1;
    }
    return 0;
}

void timing_end(timing_t *timing)
{
    for (int row = 0; row < TIMING_ROWS; row++)
        free(timing->rows[row]);
}

/* An emulated counter ticks more than once an instruction, so that rounding gives the exact number of them. */
static double units_of(const timing_t *timing, double ticks)
{
    return floor(ticks / timing->ticks_of_unit + 0.5);
}

void timing_add(timing_t *timing, unsigned sample, const answer_t *answer)
{
    double all = 0.0;

    for (int i = 0; i < 3; i++) {
        timing->rows[TIMING_UPDATE + i][sample] = units_of(timing, answer->ticks[i]);
        all += timing->rows[TIMING_UPDATE + i][sample];
    }
    timing->rows[TIMING_ALL][sample] = all;
    timing->rows[TIMING_ROUND_TRIP][sample] = 1e6 * answer->round_trip;
}

/* ---- the table ------------------------------------------------------------------------------------------ */

typedef struct {
    double least, median, most;
    unsigned worst; /* the first sample that took the most */
} summary_t;

static int ascending(const void *a, const void *b)
{
    const double first = *(const double *)a, second = *(const double *)b;

    return (first > second) - (first < second);
}

static int summarise(const double *row, unsigned count, summary_t *summary)
{
    double *sorted = malloc(count * sizeof sorted[0]);

    if (!sorted)
        return -1;
    memcpy(sorted, row, count * sizeof sorted[0]);
    qsort(sorted, count, sizeof sorted[0], ascending);
    summary->least = sorted[0];
    summary->median = sorted[count / 2];
    summary->most = sorted[count - 1];
    summary->worst = 0;
    while (row[summary->worst] < summary->most)
        summary->worst++;
    free(sorted);
    return 0;
}

void timing_print(const timing_t *timing, unsigned count)
{
    summary_t summary;

    if (count == 0)
        return;
    printf("  %-22s %10s %10s %10s %14s\n", timing->unit, "least", "median", "most", "worst sample");
    for (int row = 0; row < TIMING_ROWS; row++)
        if (summarise(timing->rows[row], count, &summary) == 0)
            printf("  %-*s %10.0f %10.0f %10.0f %14u\n", row == TIMING_ROUND_TRIP ? 23 : 22, titles[row], summary.least,
                   summary.median, summary.most, summary.worst);
    if (timing->frequency > 0.0 && summarise(timing->rows[TIMING_ALL], count, &summary) == 0)
        printf("  At %.0f MHz the longest sample takes %.1f µs, %.2f %% of the sample time.\n",
               1e-6 * timing->frequency, 1e6 * summary.most / timing->frequency,
               100.0 * summary.most / timing->frequency / (double)controller_sample_time);
}

int timing_write_csv(const timing_t *timing, unsigned count, const char *path)
{
    FILE *file = fopen(path, "w");
    int failed;

    if (!file)
        return -1;
    fprintf(file, "sample,update,control,predict,all,round_trip_us\n");
    for (unsigned k = 0; k < count; k++) {
        fprintf(file, "%u", k);
        for (int row = 0; row < TIMING_ROWS; row++)
            fprintf(file, row == TIMING_ROUND_TRIP ? ",%.1f" : ",%.0f", timing->rows[row][k]);
        fprintf(file, "\n");
    }
    failed = ferror(file);
    return fclose(file) == 0 && !failed ? 0 : -1;
}
