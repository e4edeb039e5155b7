/* SPDX-License-Identifier: MIT */
/* A mass on a frictionless axis, let go 10 mm away, is brought to 0 by the controller of double_integrator.toml. A few
 * lines of physics stand in for the hardware: it runs on any board as it is, and prints where the mass is.
 *
 * double_integrator.h was made by
 *
 *     lqgen double_integrator.toml --only h --style compact */
#include <stdio.h>

#include "double_integrator.h"

typedef struct {
    float position, speed; /* m, m/s */
} mass_t;

/* One sample time at a constant acceleration [m/s²]. */
static void move(mass_t *mass, float acceleration)
{
    const float T = DOUBLE_INTEGRATOR_SAMPLE_TIME;

    mass->position += T * mass->speed + 0.5f * T * T * acceleration;
    mass->speed += T * acceleration;
}

/* Two seconds. 0: the mass has come to rest at 0. */
static int regulate(void)
{
    static double_integrator_t loop;
    mass_t mass = {0.01f, 0.0f};

    double_integrator_init(&loop);
    for (int k = 0; k < 200; k++) {
        const float y[DOUBLE_INTEGRATOR_NY] = {mass.position};
        float u[DOUBLE_INTEGRATOR_NU];

        double_integrator_step(&loop, y, u);
        move(&mass, u[DOUBLE_INTEGRATOR_U_ACCELERATION]);
        if (k % 20 == 0)
            printf("%d ms: %d um\n", 10 * k, (int)(mass.position * 1e6f));
    }
    return mass.position < 1e-5f && mass.position > -1e-5f ? 0 : 1;
}

#ifdef ESP_PLATFORM
void app_main(void);

void app_main(void)
{
    printf(regulate() ? "the mass is NOT at 0\n" : "the mass is at 0\n");
}
#else
int main(void)
{
    const int failed = regulate();

    printf(failed ? "the mass is NOT at 0\n" : "the mass is at 0\n");
    return failed;
}
#endif
