/* SPDX-License-Identifier: MIT */
/* The pendulum, with its Jacobians by hand. */
static const real_t gravity = (real_t)9.81, length = (real_t)0.35, friction = (real_t)0.005;
static const real_t inertia = (real_t)(0.2 * 0.35 * 0.35);

static void rates(const real_t x[NX], const real_t u[NU], real_t f[NX], real_t J[NX * NX])
{
    f[0] = x[1];
    f[1] = (u[0] - friction * x[1]) * (1 / inertia) - gravity / length * sin(x[0]);
    J[0] = 0;
    J[1] = 1;
    J[2] = -(gravity / length) * cos(x[0]);
    J[3] = -(friction / inertia);
}

static void outputs(const real_t x[NX], real_t h[NY], real_t H[NY * NX])
{
    h[0] = x[0];
    H[0] = 1;
    H[1] = 0;
}
