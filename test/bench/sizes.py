# SPDX-License-Identifier: MIT
"""sizes.py dense|chain STATES STYLE > DESIGN.toml: a stable plant, dense or a chain of damped masses, whose filter
updates P as it is. Every second state is measured, every third drives an input."""

import random
import sys


def zeros(rows, columns):
    return [[0.0] * columns for _ in range(rows)]


def dense(nx, nu, ny):
    numbers = random.Random(nx)
    entries = lambda rows, columns, largest: [  # noqa: E731
        [numbers.uniform(-largest, largest) for _ in range(columns)] for _ in range(rows)
    ]
    return entries(nx, nx, 0.8 / nx**0.5), entries(nx, nu, 1), entries(ny, nx, 1)


def chain(nx, nu, ny):
    """Position and speed of each mass, in turn; a last position alone follows the mass before it."""
    period, stiffness, damping, ground = 0.05, 1.0, 0.1, 0.2
    A, B, C = zeros(nx, nx), zeros(nx, nu), zeros(ny, nx)
    masses = nx // 2
    for i in range(masses):
        position, speed = 2 * i, 2 * i + 1
        A[position][position], A[position][speed] = 1 - 0.2 * period, period
        A[speed][position], A[speed][speed] = -ground * period, 1 - ground * period
        for j in (i - 1, i + 1):
            if 0 <= j < masses:
                A[speed][2 * j] += stiffness * period
                A[speed][position] -= stiffness * period
                A[speed][2 * j + 1] += damping * period
                A[speed][speed] -= damping * period
    if nx % 2:
        A[nx - 1][nx - 1] = 0.9
        if masses:
            A[nx - 1][nx - 3] = 0.1
    for i in range(ny):
        C[i][min(2 * i, nx - 1)] = 1.0
    for j in range(nu):
        B[min(2 * (j * masses // nu) + 1, nx - 1)][j] = period
    return A, B, C


def text(matrix):
    return "[" + ", ".join("[" + ", ".join(f"{entry:.6g}" for entry in row) + "]" for row in matrix) + "]"


def main():
    kind, nx, style = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    nu, ny = max(1, nx // 3), max(1, nx // 2)
    A, B, C = (dense if kind == "dense" else chain)(nx, nu, ny)
    print(
        f'name = "plant"\n[plant]\ndomain = "discrete"\nsample_time = 0.05\nA = {text(A)}\nB = {text(B)}\nC = {text(C)}'
    )
    print(f'[lqr]\nQ = {[1] * nx}\nR = {[1] * nu}\ncost = "discrete"')
    print(f"[kalman]\nprocess_noise = {[0.01] * nx}\nmeasurement_noise = {[0.1] * ny}")
    print('noise = "discrete"\ngain = "online"\ncovariance = "plain"')
    print(f'[code]\nreal = "float"\nstyle = "{style}"')


main()
