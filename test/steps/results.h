/* SPDX-License-Identifier: MIT */
/* How a comparison ended. */
#ifndef TEST_STEPS_RESULTS_H
#define TEST_STEPS_RESULTS_H

#include "lqg/status.h"

enum { HOSTILE_SAMPLES = 20000 };

typedef struct {
    unsigned differences; /* samples after which a bit of the state, of u or of the status differed */
    unsigned honest;      /* samples of LQG_OK */
    lqg_status_t seen;    /* all bits of all samples */
} result_t;

#endif
