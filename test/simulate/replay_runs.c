/* SPDX-License-Identifier: MIT */
/* Holds the runs of record_runs against the compiled header of their controller.
 *
 *     replay_runs "<design> <arithmetic> <style> <real>" FILE
 */
#include <stdio.h>
#include <string.h>

#define CONTROLLER(name, arithmetic, style, real) int name##_##arithmetic##_##style##_##real(FILE *file);
#define WITH_plain_float
#define WITH_plain_double
#define WITH_fused_float
#define WITH_fused_double
#include "controllers.h"
#undef CONTROLLER

static const struct {
    const char *name;
    int (*replay)(FILE *file);
} controllers[] = {
#define CONTROLLER(name, arithmetic, style, real) \
    {#name " " #arithmetic " " #style " " #real, name##_##arithmetic##_##style##_##real},
#include "controllers.h"
};

int main(int count, char *arguments[])
{
    FILE *file = count == 3 ? fopen(arguments[2], "rb") : NULL;

    if (file == NULL) {
        printf("expected a controller and a file of record_runs\n");
        return 2;
    }
    for (size_t i = 0; i < sizeof controllers / sizeof controllers[0]; i++)
        if (strcmp(controllers[i].name, arguments[1]) == 0)
            return controllers[i].replay(file);
    printf("%s: there is no such controller\n", arguments[1]);
    return 2;
}
