/* SPDX-License-Identifier: MIT */
/* For each controller of controllers.h: step leaves the bits of state, u and status that the calls leave, on hostile
 * signals and with flipped bits in the state. That these have provoked resets and have let honest samples pass is
 * asked for, too. Prints a line for each controller that fails. */
#include <stdio.h>

#include "results.h"

#define CONTROLLER(name, arithmetic, style, real) result_t name##_##arithmetic##_##style##_##real(void);
#include "controllers.h"
#undef CONTROLLER

static int failures = 0, controllers = 0;

static void judge(const char *controller, result_t result)
{
    controllers++;
    if (result.differences == 0 && result.honest >= HOSTILE_SAMPLES / 100 && (result.seen & LQG_STATE_RESET) != 0)
        return;
    failures++;
    printf("%s: %u of %d samples differ; %u without a fault; status bits seen: 0x%x\n", controller, result.differences,
           (int)HOSTILE_SAMPLES, result.honest, (unsigned)result.seen);
}

int main(void)
{
#define CONTROLLER(name, arithmetic, style, real) \
    judge(#name " " #arithmetic " " #style " " #real, name##_##arithmetic##_##style##_##real());
#include "controllers.h"
#undef CONTROLLER
    printf("%d controllers, %d of them fail\n", controllers, failures);
    return failures != 0 || controllers == 0;
}
