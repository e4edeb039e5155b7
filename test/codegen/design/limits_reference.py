# SPDX-License-Identifier: MIT
# Makes limits_reference.hpp, the inputs that test_limits.cpp expects:
# python3 limits_reference.py >limits_reference.hpp, with mpmath, numpy and daqp (pip).
#
# Nothing here is shared with the design engine: ../../foresight/optimum.py has the problem over all inputs, here in 60
# digits.
import sys
from pathlib import Path

import numpy as np
from mpmath import diag, expm, inf, matrix, mp, mpf, zeros

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "foresight"))
from optimum import Problem

mp.dps = 60
TOLERANCE = mpf(10) ** -30
STATES = 12


class Random:
    """Knuth's MMIX generator"""

    def __init__(self, seed):
        self.state = seed

    def draw(self, most):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (self.state >> 33) % (most + 1)

    def number(self, scale):
        return (self.draw(2048) - 1024) / 1024 * scale


def double(rows):
    return matrix([[mpf(x) for x in row] for row in rows])


def sampled(A, B, T):
    nx, nu = A.rows, B.cols
    whole = zeros(nx + nu)
    whole[:nx, :nx], whole[:nx, nx:] = A, B
    whole = expm(whole * mpf(T), method="taylor")
    return whole[:nx, :nx], whole[:nx, nx:]


def arrays(case):
    """The matrices of a case as the shared problem takes them."""
    kept = {name: np.array(case[name].tolist()).reshape(case[name].rows, -1) for name in "ABQRN"}
    quantities = [
        (np.array(c.tolist())[0], np.array(d.tolist())[0], *rest) for c, d, *rest in case.get("quantities", [])
    ]
    return case | kept | {"quantities": quantities}


def two_mass(N):
    A = double([[0, 1, 0, 0], [-0.1, -0.004, 0.1, 0.004], [0, 0, 0, 1], [0.5, 0.02, -0.5, -0.02]])
    A, B = sampled(A, double([[0], [1], [0], [0]]), 0.5)
    return {
        "A": A,
        "B": B,
        "Q": diag([1, 0, 1, 0]),
        "R": double([[0.1]]),
        "N": double(N),
        "scale": [1] * 4,
        "quantities": [],
    }


def servo():
    A = double([[0, 1], [0, -59.2236711684]])
    A, B = sampled(A, double([[0], [2121.79407756]]), 0.001)
    return {
        "A": A,
        "B": B,
        "Q": diag([400, mpf(1) / 1024]),
        "R": double([[1 / 128]]),
        "N": zeros(2, 1),
        "scale": [1 / 16, 16],
    }


none, box = zeros(4, 1), [mpf(0.3)]
row = double([[0, 0, 1, 0]])
cases = [
    dict(two_mass(none.tolist()), blocks=[1, 1, 2, 4, 4, 8], u_min=[-box[0]], u_max=box),
    dict(two_mass([[0.05], [0], [0], [0.02]]), blocks=[1] * 10, u_min=[-box[0]], u_max=box),
    dict(
        servo(),
        blocks=[1] * 10,
        u_min=[mpf(-12)],
        u_max=[mpf(12)],
        u_step=[mpf(2)],
        step_price=mpf(10000),
        quantities=[(double([[0, 1]]), double([[0]]), False, mpf(-20), mpf(20), mpf(1000))],
    ),
    dict(
        two_mass(none.tolist()),
        blocks=[1] * 8,
        u_min=[mpf(-0.5)],
        u_max=[mpf(0.5)],
        quantities=[
            (row, double([[0.125]]), False, mpf(-1), mpf(0.75), mpf(1000)),
            (row, double([[0.125]]), True, mpf(-0.25), mpf(0.25), mpf(64)),
        ],
    ),
    {
        "A": double([[1, 0.125, 0], [0, 1, 0.25], [0.125, 0, 0.75]]),
        "B": double([[0.5, 0], [0, 1], [0.25, -0.5]]),
        "Q": diag([1, 2, 0.5]),
        "R": double([[0.5, 0.125], [0.125, 1]]),
        "N": zeros(3, 2),
        "scale": [1] * 3,
        "blocks": [1, 2, 3],
        "u_min": [mpf(-0.25), mpf(-1)],
        "u_max": [mpf(0.5), inf],
        "quantities": [(double([[1, 0, 1]]), double([[0, 0]]), False, mpf(-0.5), mpf(0.5), mpf(8))],
    },
]

print("// SPDX-License-Identifier: MIT")
print("// Made by limits_reference.py: u of each case and state, and how many limits are active there.")
print("#pragma once\n\nnamespace design_test {\n\nconstexpr int reference_states = %d;\n" % STATES)
print("struct ReferenceInput {\n  double u[2];\n  int active;\n};\n")
print("constexpr ReferenceInput reference_inputs[%d][reference_states] = {" % len(cases))
for index, case in enumerate(cases):
    problem = Problem(arrays(case))
    random = Random(index)
    random.draw(1)
    print("    {")
    for n in range(STATES):  # from near to far
        x0 = [mpf(random.number(scale) / 2 ** (n % 4)) for scale in case["scale"]]
        u_last = [mpf(random.number(8)) for _ in range(problem.nu)]
        u, active = problem.optimum(np.array(x0 + u_last), TOLERANCE)
        print("        {{%s}, %d}," % (", ".join("%.17g" % float(value) for value in u + [0] * (2 - len(u))), active))
    print("    },")
print("};\n\n}  // namespace design_test")
