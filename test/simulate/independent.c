/* SPDX-License-Identifier: MIT */
/* Another simulator around the compiled header: the scenario "heavy and late" of the servo, whose plant is integrated
 * here by Runge and Kutta's method from the equations and numbers of servo.toml. Its samples are those of
 * lqgen simulate.
 *
 *     independent SERVO_HEAVY_AND_LATE.csv
 *
 * Both begin with the same bits; the plants differ by rounding, which one float of y may pass on. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "servo.h"

#define SAMPLES 300
#define STEPS 50
static const double T = 0.001, heavier = 0.8333, tolerance = 1e-6;

struct shaft {
    double angle, speed;
};

static struct shaft slope(struct shaft at, double voltage)
{
    struct shaft out;
    out.angle = at.speed;
    out.speed = heavier * (-59.2236711684 * at.speed + 2121.79407756 * voltage);
    return out;
}

static struct shaft plus(struct shaft at, double time, struct shaft along)
{
    at.angle += time * along.angle;
    at.speed += time * along.speed;
    return at;
}

static struct shaft after_a_period(struct shaft at, double voltage)
{
    const double h = T / STEPS;
    for (int i = 0; i < STEPS; i++) {
        const struct shaft k1 = slope(at, voltage), k2 = slope(plus(at, h / 2, k1), voltage);
        const struct shaft k3 = slope(plus(at, h / 2, k2), voltage), k4 = slope(plus(at, h, k3), voltage);
        at = plus(plus(plus(plus(at, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
    }
    return at;
}

/* The number in the column of that name of the line. */
static double number_in(const char *head, const char *line, const char *name)
{
    const size_t length = strlen(name);
    while (strncmp(head, name, length) != 0 || (head[length] != ',' && head[length] != '\n')) {
        head = strchr(head, ',');
        line = strchr(line, ',');
        if (!head++ || !line++) {
            printf("expected a column %s, found none\n", name);
            exit(1);
        }
    }
    return strtod(line, NULL);
}

static int is_near(int k, const char *what, double shown, double here, double scale)
{
    if (fabs(shown - here) <= tolerance * scale)
        return 1;
    printf("sample %d, %s: lqgen simulate says %.17g, this simulator %.17g\n", k, what, shown, here);
    return 0;
}

int main(int count, char *arguments[])
{
    char head[1024], line[1024];
    FILE *file = count == 2 ? fopen(arguments[1], "r") : NULL;
    servo_t loop;
    struct shaft shaft = {0, 0};
    double on_its_way = 0;
    int k = 0;

    if (!file || !fgets(head, sizeof head, file)) {
        printf("independent SERVO_HEAVY_AND_LATE.csv\n");
        return 1;
    }
    servo_init(&loop);
    for (; fgets(line, sizeof line, file); k++) {
        float y[SERVO_NY], u[SERVO_NU];
        loop.r[0] = k >= 10 ? 0.05f : 0.0f;
        y[0] = (float)shaft.angle;
        (void)servo_step(&loop, y, u);
        if (!is_near(k, "angle", number_in(head, line, "x_angle"), shaft.angle, 0.05) ||
            !is_near(k, "speed", number_in(head, line, "x_speed"), shaft.speed, 10) ||
            !is_near(k, "voltage", number_in(head, line, "u_voltage"), (double)u[0], 10))
            return 1;
        shaft = after_a_period(shaft, on_its_way);
        on_its_way = (double)u[0];
    }
    if (k != SAMPLES)
        printf("expected %d samples, found %d\n", SAMPLES, k);
    return k == SAMPLES ? 0 : 1;
}
