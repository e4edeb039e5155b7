/* SPDX-License-Identifier: MIT */
#include "chart.h"

#include <stdio.h>

enum { COLUMNS = 96, ROWS = 9 };                 /* of characters */
enum { WIDTH = 900, HEIGHT = 150, MARGIN = 60 }; /* of a curve in the SVG, in pixels */

typedef struct {
    double low, high;
} range_t;

static range_t widen(range_t range, const double *values, int count)
{
    for (int i = 0; i < count; i++) {
        range.low = values[i] < range.low ? values[i] : range.low;
        range.high = values[i] > range.high ? values[i] : range.high;
    }
    return range;
}

/* A range with something in it and 0 in sight. */
static range_t range_of(const chart_curve_t *curve, int count)
{
    range_t range = {0.0, 0.0};

    range = widen(range, curve->values, count);
    if (curve->second)
        range = widen(range, curve->second, count);
    if (range.high - range.low < 1e-9)
        range.high = range.low + 1e-9;
    return range;
}

static int row_of(double value, range_t range)
{
    return (int)((range.high - value) / (range.high - range.low) * (ROWS - 1) + 0.5);
}

void chart_print(const chart_curve_t *curve, int count, double sample_time)
{
    const range_t range = range_of(curve, count);
    char picture[ROWS][COLUMNS + 1];

    for (int row = 0; row < ROWS; row++) {
        for (int column = 0; column < COLUMNS; column++)
            picture[row][column] = row == row_of(0.0, range) ? '-' : ' ';
        picture[row][COLUMNS] = '\0';
    }
    for (int i = 0; i < count; i++)
        picture[row_of(curve->values[i], range)][(long)i * COLUMNS / count] = '*';

    printf("\n  %s\n", curve->title);
    for (int row = 0; row < ROWS; row++)
        printf("  %9.3f |%s\n", range.high - row * (range.high - range.low) / (ROWS - 1), picture[row]);
    printf("  %9s +%-*s%*.1f s\n", "", COLUMNS / 2, " 0", COLUMNS / 2 - 2, count * sample_time);
}

static void write_line(FILE *file, const char *colour, const double *values, int count, range_t range, int top)
{
    fprintf(file, "<polyline fill=\"none\" stroke=\"%s\" points=\"", colour);
    for (int i = 0; i < count; i++)
        fprintf(file, "%.1f,%.1f ", (double)MARGIN + (double)WIDTH * i / count,
                top + (double)HEIGHT * (range.high - values[i]) / (range.high - range.low));
    fprintf(file, "\"/>\n");
}

static void write_curve(FILE *file, const chart_curve_t *curve, int count, double sample_time, int top)
{
    const range_t range = range_of(curve, count);
    const double zero = top + (double)HEIGHT * range.high / (range.high - range.low);

    fprintf(file, "<text x=\"%d\" y=\"%d\">%s</text>\n", MARGIN, top - 8, curve->title);
    fprintf(file, "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"none\" stroke=\"#bbb\"/>\n", MARGIN, top,
            WIDTH, HEIGHT);
    fprintf(file, "<line x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#bbb\"/>\n", MARGIN, MARGIN + WIDTH, zero,
            zero);
    fprintf(file, "<text x=\"4\" y=\"%d\">%.3g</text>\n<text x=\"4\" y=\"%d\">%.3g</text>\n", top + 12, range.high,
            top + HEIGHT, range.low);
    fprintf(file, "<text x=\"%d\" y=\"%d\">%.1f s</text>\n", MARGIN + WIDTH - 40, top + HEIGHT + 16,
            count * sample_time);
    if (curve->second)
        write_line(file, "#e08214", curve->second, count, range, top);
    write_line(file, "#2166ac", curve->values, count, range, top);
}

int chart_write_svg(const char *path, const char *heading, const chart_curve_t curves[], int curve_count, int count,
                    double sample_time)
{
    FILE *file = fopen(path, "w");
    int failed;

    if (!file)
        return -1;
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
            "font-family=\"sans-serif\" font-size=\"13\">\n",
            WIDTH + 2 * MARGIN, curve_count * (HEIGHT + 50) + 50);
    fprintf(
        file,
        "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n<text x=\"%d\" y=\"24\" font-size=\"16\">%s</text>\n",
        MARGIN, heading);
    for (int i = 0; i < curve_count; i++)
        write_curve(file, &curves[i], count, sample_time, 60 + i * (HEIGHT + 50));
    fprintf(file, "</svg>\n");
    failed = ferror(file);
    return fclose(file) == 0 && !failed ? 0 : -1;
}
