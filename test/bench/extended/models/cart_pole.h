/* SPDX-License-Identifier: MIT */
/* The cart with a pole, with its Jacobians by hand. */
static const real_t gravity = (real_t)9.81, cart = (real_t)0.8, pole = (real_t)0.25, length = (real_t)0.4;
static const real_t friction = (real_t)0.6;

static void rates(const real_t x[NX], const real_t u[NU], real_t f[NX], real_t J[NX * NX])
{
    const real_t s = sin(x[1]), c = cos(x[1]), rate = x[3];
    const real_t force = u[0] - friction * x[2], turning = pole * length * rate;
    const real_t over_mass = 1 / (cart + pole * s * s), over_inertia = over_mass / length;
    const real_t slope_of_mass = 2 * pole * s * c;

    f[0] = x[2];
    f[1] = rate;
    f[2] = (force + s * (turning * rate + pole * gravity * c)) * over_mass;
    f[3] = -(force * c + turning * rate * s * c + (cart + pole) * gravity * s) * over_inertia;
    for (int i = 0; i < NX * NX; i++)
        J[i] = 0;
    J[2] = 1;
    J[7] = 1;
    J[9] = (c * turning * rate + pole * gravity * (c * c - s * s) - f[2] * slope_of_mass) * over_mass;
    J[10] = -friction * over_mass;
    J[11] = 2 * turning * s * over_mass;
    J[13] = (force * s - turning * rate * (c * c - s * s) - (cart + pole) * gravity * c) * over_inertia -
            f[3] * slope_of_mass * over_mass;
    J[14] = friction * c * over_inertia;
    J[15] = -2 * turning * s * c * over_inertia;
}

static void outputs(const real_t x[NX], real_t h[NY], real_t H[NY * NX])
{
    h[0] = x[0];
    h[1] = x[1];
    for (int i = 0; i < NY * NX; i++)
        H[i] = 0;
    H[0] = 1;
    H[5] = 1;
}
