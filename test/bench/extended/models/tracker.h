/* SPDX-License-Identifier: MIT */
/* The robot seen from a beacon, with its Jacobians by hand. */
static const real_t period = (real_t)0.1, slow = (real_t)0.998;

static void next_state(const real_t x[NX], const real_t u[NU], real_t f[NX], real_t F[NX * NX])
{
    const real_t s = period * sin(x[2]), c = period * cos(x[2]);

    f[0] = x[0] + c * x[3];
    f[1] = x[1] + s * x[3];
    f[2] = x[2] + period * u[0];
    f[3] = slow * x[3];
    for (int i = 0; i < NX * NX; i++)
        F[i] = 0;
    F[0] = 1;
    F[2] = -s * x[3];
    F[3] = c;
    F[5] = 1;
    F[6] = c * x[3];
    F[7] = s;
    F[10] = 1;
    F[15] = slow;
}

static void outputs(const real_t x[NX], real_t h[NY], real_t H[NY * NX])
{
    const real_t square = x[0] * x[0] + x[1] * x[1], distance = sqrt(square);

    h[0] = distance;
    h[1] = atan2(x[1], x[0]);
    for (int i = 0; i < NY * NX; i++)
        H[i] = 0;
    H[0] = x[0] / distance;
    H[1] = x[1] / distance;
    H[4] = -x[1] / square;
    H[5] = x[0] / square;
}
