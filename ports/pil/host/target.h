/* SPDX-License-Identifier: MIT */
/* The target as the host sees it: requests and their answers. Whatever goes wrong is said on standard error. */
#ifndef TARGET_H
#define TARGET_H

#include "controller.h"
#include "line.h"
#include "protocol.h"

typedef struct {
    line_t line;
    pil_decoder_t decoder;
    double patience; /* s that an answer may take */
} target_t;

typedef struct {
    float u[CONTROLLER_NU];
    lqg_status_t status; /* of update and control */
    lqg_status_t status_of_predict;
    uint32_t ticks[3]; /* of update, control, predict */
    uint16_t crc;      /* of the controller's state after predict */
    double round_trip; /* s from the first byte of y to the last of u */
} answer_t;

/* These return 0, or −1. Greeting is tried for five times `patience`: a board may be starting. */
int target_greet(target_t *target, pil_hello_t *hello);
int target_start(target_t *target);
int target_run_sample(target_t *target, uint16_t sequence, const float y[CONTROLLER_NY], answer_t *answer);

/* Whether the target runs the very controller that this program has. */
int target_has_our_controller(const pil_hello_t *hello);

#endif
