/* SPDX-License-Identifier: MIT */
/* Curves over time: as characters for a terminal, as SVG for a browser. */
#ifndef CHART_H
#define CHART_H

typedef struct {
    const char *title;    /* with the unit */
    const double *values; /* one a sample */
    const double *second; /* another curve, or NULL: drawn behind the first */
} chart_curve_t;

/* Draws the curve on standard output, some rows high. */
void chart_print(const chart_curve_t *curve, int count, double sample_time);

/* Writes all curves, one above the other, to a file; returns 0, or −1 if it cannot be written. */
int chart_write_svg(const char *path, const char *heading, const chart_curve_t curves[], int curve_count, int count,
                    double sample_time);

#endif
