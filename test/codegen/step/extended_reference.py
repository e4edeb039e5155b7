# SPDX-License-Identifier: MIT
"""Extended Kalman filters with 60 digits, in matrices and with Jacobians by differences.

Use: python3 extended_reference.py | clang-format-19 > extended_reference.hpp

Nothing here is made as the code makes it: all outputs of a sample are one update, S is inverted as a matrix, and
(f(x + h) - f(x - h))/2h with h = 1e-40 takes the place of dual numbers.
"""

import math
import random

import mpmath as mp

mp.mp.dps = 120
STEP = mp.mpf(10) ** -40
SAMPLES = 20


def jacobian(function, x):
    columns = []
    for j in range(len(x)):
        up, down = list(x), list(x)
        up[j] += STEP
        down[j] -= STEP
        columns.append([(a - b) / (2 * STEP) for a, b in zip(function(up), function(down))])
    return mp.matrix(columns).T


def runge_kutta(rate, period):
    def step(x, u):
        def moved(c, k):
            return [a + c * b for a, b in zip(x, k)]

        k1 = rate(x, u)
        k2 = rate(moved(period / 2, k1), u)
        k3 = rate(moved(period / 2, k2), u)
        k4 = rate(moved(period, k3), u)
        return [a + period / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(x, k1, k2, k3, k4)]

    return step


def wrapped(angle):
    return angle - 2 * mp.pi * mp.floor((angle + mp.pi) / (2 * mp.pi))


def extended_filter(step, outputs, wraps, W, V, x, P, y, u):
    """x and P after the prediction of each sample. A None of y is missing."""
    answers = []
    for measured, applied in zip(y, u):
        there = [i for i, value in enumerate(measured) if value is not None]
        if there:
            h = outputs(x, applied)
            C = jacobian(lambda at, u=applied: outputs(at, u), x)
            C = mp.matrix([[C[i, j] for j in range(len(x))] for i in there])
            differences = [mp.mpf(measured[i]) - h[i] for i in there]
            nu = mp.matrix([wrapped(d) if wraps[i] else d for i, d in zip(there, differences)])
            S = C * P * C.T + mp.matrix([[V[i][j] for j in there] for i in there])
            L = P * C.T * S**-1
            x = list(mp.matrix(x) + L * nu)
            P = P - L * C * P
        A = jacobian(lambda at, u=applied: step(at, u), x)
        x = step(x, applied)
        P = A * P * A.T + W
        answers.append((x, P))
    return answers


def diagonal(values):
    return mp.diag([mp.mpf(value) for value in values])


def on_grid(value, bits=12):
    return math.floor(value * 2**bits + 0.5) / 2**bits


# Cart and pole: position, speed, angle from upright, its rate; a force.
def cart_rate(x, u):
    _, v, th, om = x
    d = mp.mpf
    s, c = mp.sin(th), mp.cos(th)
    mass = d(0.5) + d(0.2) * s**2
    return [
        v,
        (u[0] - d(0.1) * v + d(0.2) * s * (d(0.3) * om**2 - d(9.81) * c)) / mass,
        om,
        (d(9.81) * d(0.7) * s - c * (u[0] - d(0.1) * v + d(0.2) * d(0.3) * om**2 * s)) / (d(0.3) * mass),
    ]


def cart():
    chance = random.Random(1)
    step = runge_kutta(cart_rate, mp.mpf(0.01))
    truth = [mp.mpf(0), mp.mpf(0.25), mp.mpf(0.5), mp.mpf(-0.5)]
    y, u = [], []
    for k in range(SAMPLES):
        u.append([on_grid(2 * math.sin(k), 6)])
        y.append([on_grid(float(truth[0]) + chance.gauss(0, 0.02)), on_grid(float(truth[2]) + chance.gauss(0, 0.05))])
        truth = step(truth, u[-1])
    y[7][1] = None
    y[11] = [None, None]
    V = [[mp.mpf(0.0004), mp.mpf(0.0002)], [mp.mpf(0.0002), mp.mpf(0.0025)]]
    W, P = diagonal([1e-6, 1e-4, 1e-6, 1e-3]), diagonal([0.01, 1, 0.25, 1])
    x = [mp.mpf(0), mp.mpf(0), mp.mpf(0.25), mp.mpf(0)]
    return y, u, extended_filter(step, lambda x, u: [x[0], x[2]], [False, True], W, V, x, P, y, u)


# A ship that turns, seen by distance and bearing from the origin, behind which it passes: the bearing jumps from π to
# −π. Its rate of turn is the input.
def ship_step(x, u):
    px, py, heading, speed = x
    period = mp.mpf(0.5)
    return [
        px + period * speed * mp.cos(heading),
        py + period * speed * mp.sin(heading),
        heading + period * u[0],
        speed * mp.exp(-period / 64),
    ]


def ship():
    chance = random.Random(2)
    truth = [mp.mpf(-40), mp.mpf(20), mp.mpf(-1.5), mp.mpf(6)]
    y, u = [], []
    for k in range(SAMPLES):
        u.append([on_grid(0.1 * math.cos(k / 4), 8)])
        distance, bearing = mp.hypot(truth[0], truth[1]), mp.atan2(truth[1], truth[0])
        y.append([on_grid(float(distance) + chance.gauss(0, 0.5)), on_grid(float(bearing) + chance.gauss(0, 0.02))])
        truth = ship_step(truth, u[-1])
    y[3][0] = None

    def outputs(x, u):
        return [mp.sqrt(x[0] ** 2 + x[1] ** 2), mp.atan2(x[1], x[0])]

    V = [[mp.mpf(0.25), mp.mpf(0)], [mp.mpf(0), mp.mpf(0.0004)]]
    W, P = diagonal([0.01, 0.01, 1e-4, 0.01]), diagonal([25, 25, 0.25, 4])
    x = [mp.mpf(-38), mp.mpf(22), mp.mpf(-1.25), mp.mpf(5)]
    return y, u, extended_filter(ship_step, outputs, [False, True], W, V, x, P, y, u)


def number(value):
    return "missing" if value is None else mp.nstr(mp.mpf(value), 20, strip_zeros=True)


def table(name, rows):
    width = len(rows[0])
    print(f"constexpr double {name}[samples][{width}] = {{")
    for row in rows:
        line, lines = "    {", []
        for i, value in enumerate(row):
            word = number(value) + ("," if i + 1 < width else "},")
            if len(line) + len(word) > 115:
                lines.append(line.rstrip())
                line = "     "
            line += word + " "
        print("\n".join([*lines, line.rstrip()]))
    print("};")


def main():
    print("// SPDX-License-Identifier: MIT")
    print("// Made by extended_reference.py: outputs, inputs, and x and P (lower triangle) behind each prediction.")
    print("#pragma once\n\n#include <limits>\n\nnamespace extended_reference {\n")
    print(f"constexpr int samples = {SAMPLES};")
    print("constexpr double missing = std::numeric_limits<double>::quiet_NaN();\n")
    for name, (y, u, answers) in [("cart", cart()), ("ship", ship())]:
        table(f"{name}_y", y)
        table(f"{name}_u", u)
        table(f"{name}_x", [list(x) for x, _ in answers])
        table(f"{name}_P", [[P[i, j] for i in range(P.rows) for j in range(i + 1)] for _, P in answers])
        print()
    print("}  // namespace extended_reference")


main()
