/* SPDX-License-Identifier: MIT */
/* A status in words. */
#include "lqg/status.h"

const char *lqg_status_text(lqg_status_t status)
{
    if (status & LQG_STATE_RESET)
        return "the state left its bounds and begins anew";
    if (status & LQG_COVARIANCE_RESET)
        return "the covariance was none and begins anew";
    if (status & LQG_INNOVATION_NOT_POSITIVE)
        return "the variance of an innovation was not positive: the output was not used";
    if (status & LQG_REFERENCE_NOT_FINITE)
        return "a reference was not finite and counted as 0";
    if (status & LQG_OUTPUT_REJECTED)
        return "an output was not finite or absurd and was not used";
    if (status & LQG_OUTPUT_GATED)
        return "an output was too unlikely and was not used";
    if (status & LQG_NOT_OPTIMAL)
        return "no optimum within the limits was found: the inputs are those of the law, clipped";
    if (status & LQG_INPUT_LIMITED)
        return "an input was limited";
    return "all is well";
}
