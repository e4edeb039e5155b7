#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The plant of balancing_robot.toml for a robot of your own: put in what you weighed and measured, run it, and
replace A, B and G of the design's [plant] by what it prints.

The equations are those in the head of balancing_robot.toml. A motor's constants from its data sheet, all at the
wheel, behind the gears: at voltage u it has no-load speed w0 [rad/s] at current i0 [A], stall torque Ts [N m] at
stall current Is [A]. Then Rm = u/Is, Kt = Ts/Is, Kb = (u - Rm i0)/w0, fm = Kt i0/w0. Jm is the rotor's inertia times
the square of the gear ratio. The NXT motors' are those of Yamamoto's NXTway-GS."""

g = 9.81  # m/s²
m = 0.03  # kg, a wheel
R = 0.04  # m, its radius
M = 0.6  # kg, the body with battery and motors
L = 0.072  # m, its centre of mass above the axle
Jm = 1e-5  # kg m², the motor
Rm = 6.69  # Ω
Kb = 0.468  # V s/rad
Kt = 0.317  # N m/A
fm = 0.0022  # N m s/rad

Jw = m * R**2 / 2
Jp = M * L**2 / 3
alpha = Kt / Rm
beta = Kt * Kb / Rm + fm

# E [θ̈; ψ̈] = −2β [1 −1; −1 1] [θ̇; ψ̇] + [0; M g L ψ] + 2α [1; −1] u + w
E = [[(2 * m + M) * R**2 + 2 * Jw + 2 * Jm, M * L * R - 2 * Jm], [M * L * R - 2 * Jm, M * L**2 + Jp + 2 * Jm]]
det = E[0][0] * E[1][1] - E[0][1] * E[1][0]
inverse = [[E[1][1] / det, -E[0][1] / det], [-E[1][0] / det, E[0][0] / det]]


def accelerations(wheel_torque, body_torque):
    return [row[0] * wheel_torque + row[1] * body_torque for row in inverse]


tilt = accelerations(0, M * g * L)
slip = accelerations(-2 * beta, 2 * beta)
motor = accelerations(2 * alpha, -2 * alpha)
print("A = [[0, 0, 1, 0],\n     [0, 0, 0, 1],")
for i in (0, 1):
    print(f"     [0, {tilt[i]:.12g}, {slip[i]:.12g}, {-slip[i]:.12g}]{',' if i == 0 else ']'}")
print(f"B = [[0], [0], [{motor[0]:.12g}], [{motor[1]:.12g}]]")
print("G = [[0, 0], [0, 0],")
for i in (0, 1):
    print(f"     [{inverse[i][0]:.12g}, {inverse[i][1]:.12g}]{',' if i == 0 else ']'}")
