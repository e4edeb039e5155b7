/* SPDX-License-Identifier: MIT */
/* Processor in the loop: the plant is here (plant.h), its controller runs on a target at the other end of a line.
 *
 *     pil [option…] --port DEVICE [--baud 115200]
 *     pil [option…] -- COMMAND…                     the target is a program, the line its standard input and output
 *
 *     --seconds S    of simulated time, default 10 for the robot, all samples for another design
 *     --patience S   that an answer may take, default 2
 *     --csv FILE     what every sample took
 *     --svg FILE     the robot's pitch, the first input and what every sample took, as curves
 *
 * Every u, every status and a CRC of the controller's state after every sample are compared with those of the same
 * controller that runs here. Exit status 0: all bits were the same, and the robot stood at the end; 1: they were not,
 * or it did not; 2: the command line is wrong; 3: no connection, damage on the line, or another controller; 4: a file
 * could not be written. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../pc/chart.h"
#include "controller.h"
#include "plant.h"
#include "target.h"
#include "timing.h"

enum { GOOD = 0, BAD = 1, USAGE = 2, NO_TARGET = 3, NO_FILE = 4 };

/* ---- the command line ----------------------------------------------------------------------------------- */

typedef struct {
    const char *port, *csv, *svg;
    double seconds, patience, baud;
    char **command;
} options_t;

static int read_number(const char *text, double *number)
{
    char *end;

    *number = strtod(text, &end);
    return *end == '\0' && end != text && *number > 0.0 && *number <= 1e6 ? 0 : -1;
}

static int read_option(const char *name, const char *value, options_t *options)
{
    if (strcmp(name, "--port") == 0)
        options->port = value;
    else if (strcmp(name, "--csv") == 0)
        options->csv = value;
    else if (strcmp(name, "--svg") == 0)
        options->svg = value;
    else if (strcmp(name, "--seconds") == 0)
        return read_number(value, &options->seconds);
    else if (strcmp(name, "--patience") == 0)
        return read_number(value, &options->patience);
    else if (strcmp(name, "--baud") == 0)
        return read_number(value, &options->baud);
    else
        return -1;
    return 0;
}

static int read_command_line(int argc, char **argv, options_t *options)
{
    int i = 1;

    for (; i < argc && strcmp(argv[i], "--") != 0; i += 2)
        if (i + 1 == argc || read_option(argv[i], argv[i + 1], options) != 0) {
            fprintf(stderr, "Do not understand %s: see the top of ports/pil/host/main.c\n", argv[i]);
            return -1;
        }
    if (i < argc - 1)
        options->command = argv + i + 1;
    if ((options->port != NULL) == (options->command != NULL)) {
        fprintf(stderr, "Expected either --port DEVICE or -- COMMAND…\n");
        return -1;
    }
    return 0;
}

/* ---- the loop ------------------------------------------------------------------------------------------- */

typedef struct {
    unsigned count;     /* samples that are to be run */
    unsigned done;      /* that have been */
    unsigned different; /* of these: not the bits of the host */
    unsigned first_different;
    double *value, *input; /* plant_value, u[0] */
} run_t;

/* The same sample here, with the u of the target applied. */
static int has_our_bits(controller_t *loop, const float *y, const answer_t *answer)
{
    float u[CONTROLLER_NU];
    lqg_status_t status = controller_update(loop, y);
    lqg_status_t status_of_predict;

    status |= controller_control(loop, u);
    status_of_predict = controller_predict(loop, answer->u);
    return memcmp(u, answer->u, sizeof u) == 0 && status == answer->status &&
           status_of_predict == answer->status_of_predict &&
           pil_crc_of_floats((const float *)loop, CONTROLLER_FLOATS) == answer->crc;
}

static int run_loop(target_t *target, timing_t *timing, run_t *run)
{
    controller_t loop;

    controller_init(&loop);
    for (unsigned k = 0; k < run->count; k++) {
        float y[CONTROLLER_NY];
        answer_t answer;

        plant_read_sensors(k, y);
        if (target_run_sample(target, (uint16_t)(k & 0xFFFF), y, &answer) != 0)
            return -1;
        if (!has_our_bits(&loop, y, &answer) && run->different++ == 0)
            run->first_different = k;
        timing_add(timing, k, &answer);
        run->value[k] = plant_value();
        run->input[k] = (double)answer.u[0];
        run->done = k + 1;
        plant_apply(k, answer.u);
    }
    return 0;
}

/* ---- the report ----------------------------------------------------------------------------------------- */

static int write_files(const options_t *options, const timing_t *timing, const run_t *run)
{
    char title[32];
    const chart_curve_t curves[] = {
        {plant_quantity, run->value, NULL}, {"first input", run->input, NULL}, {title, timing->rows[TIMING_ALL], NULL}};
    const int count = (int)run->done;
    int status = GOOD;

    snprintf(title, sizeof title, "%s of a sample", timing->unit);
    if (options->csv && timing_write_csv(timing, run->done, options->csv) != 0) {
        fprintf(stderr, "%s cannot be written\n", options->csv);
        status = NO_FILE;
    }
    if (options->svg &&
        chart_write_svg(options->svg, "Processor in the loop", curves, 3, count, (double)controller_sample_time) != 0) {
        fprintf(stderr, "%s cannot be written\n", options->svg);
        status = NO_FILE;
    }
    return status;
}

static int report(const timing_t *timing, const run_t *run)
{
    int is_well;

    printf("%u samples of %g s\n\n", run->done, (double)controller_sample_time);
    timing_print(timing, run->done);
    if (run->different)
        printf("\n  %u samples had OTHER BITS than here, the first of them number %u.\n", run->different,
               run->first_different);
    else
        printf("\n  Every u, status and state of the target had the bits of this machine's.\n");
    is_well = plant_report(run->done * (double)controller_sample_time);
    return is_well && run->different == 0 ? GOOD : BAD;
}

/* ---- a session ------------------------------------------------------------------------------------------ */

static int run_session(const options_t *options, target_t *target, timing_t *timing, run_t *run)
{
    pil_hello_t hello;
    int written, status;

    if (target_greet(target, &hello) != 0 || !target_has_our_controller(&hello))
        return NO_TARGET;
    if (timing_start(timing, run->count, &hello, options->command != NULL) != 0) {
        fprintf(stderr, "No memory for %u samples\n", run->count);
        return NO_FILE;
    }
    if (target_start(target) != 0 || run_loop(target, timing, run) != 0)
        return NO_TARGET;
    printf("  %s on the target, %s: ", hello.name, plant_place);
    status = report(timing, run);
    written = write_files(options, timing, run);
    return status != GOOD ? status : written;
}

int main(int argc, char **argv)
{
    options_t options = {.patience = 2.0, .baud = 115200.0};
    target_t target = {.line = {.file = -1}};
    timing_t timing = {.count = 0};
    run_t run = {.count = 0};
    int status = NO_TARGET;

    if (read_command_line(argc, argv, &options) != 0)
        return USAGE;
    target.patience = options.patience;
    run.count = plant_samples(options.seconds);
    run.value = calloc(run.count, sizeof run.value[0]);
    run.input = calloc(run.count, sizeof run.input[0]);
    if (run.value && run.input &&
        (options.command ? line_start(&target.line, options.command)
                         : line_open(&target.line, options.port, (unsigned long)options.baud)) == 0)
        status = run_session(&options, &target, &timing, &run);
    line_close(&target.line);
    timing_end(&timing);
    free(run.value);
    free(run.input);
    return status;
}
