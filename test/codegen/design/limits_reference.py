# SPDX-License-Identifier: MIT
# Makes limits_reference.hpp, the inputs that test_limits.cpp expects:
# python3 limits_reference.py >limits_reference.hpp, with mpmath, numpy and daqp (pip).
#
# Nothing here is shared with the design engine. All inputs of the horizon are unknowns, the cost is summed sample by
# sample with xᵀXx at the end, X by the Riccati recursion; that v is held over a block is an equation. DAQP finds which
# limits are active; what follows from these is solved, and its conditions are checked, in 60 digits.
import daqp
import numpy as np
from mpmath import diag, expm, eye, inf, lu_solve, matrix, mp, mpf, zeros

mp.dps = 60
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


def riccati(A, B, Q, R, N):
    X = Q
    while True:
        K = (R + B.T * X * B) ** -1 * (B.T * X * A + N.T)
        after = A.T * X * A + Q - (A.T * X * B + N) * K
        if mp.norm(after - X, 1) < mpf(10) ** -50 * mp.norm(X, 1):
            return after, K
        X = after


class Affine:
    """constant + rows · unknowns"""

    def __init__(self, constant, rows):
        self.constant, self.rows = constant, rows

    def __add__(self, other):
        return Affine(self.constant + other.constant, self.rows + other.rows)

    def __sub__(self, other):
        return Affine(self.constant - other.constant, self.rows - other.rows)

    def times(self, M):
        return Affine(M * self.constant, M * self.rows)


def optimum(case, x0, u_last):
    A, B, K, X = case["A"], case["B"], case["K"], case["X"]
    nx, nu, blocks = A.rows, B.cols, case["blocks"]
    firsts = [sum(blocks[:b]) for b in range(len(blocks))]
    horizon = sum(blocks)
    xs, us = [Affine(x0, zeros(nx, horizon * nu))], []
    for k in range(horizon):
        rows = zeros(nu, horizon * nu)
        for i in range(nu):
            rows[i, k * nu + i] = 1
        us.append(Affine(zeros(nu, 1), rows))
        xs.append(xs[k].times(A) + us[k].times(B))
    H, g = zeros(horizon * nu), zeros(horizon * nu, 1)

    def add_cost(a, weight, b):
        nonlocal H, g
        H += a.rows.T * weight * b.rows + (a.rows.T * weight * b.rows).T
        g += a.rows.T * weight * b.constant + b.rows.T * weight.T * a.constant

    for k in range(horizon):
        add_cost(xs[k], case["Q"], xs[k])
        add_cost(us[k], case["R"], us[k])
        add_cost(xs[k].times(2 * eye(nx)), case["N"], us[k])
    add_cost(xs[horizon], X, xs[horizon])

    limits, prices = [], []  # (row, low, high); its price or None

    def limit(z, low, high, price):
        for i in range(len(z.constant)):
            limits.append((z.rows[i, :], low[i] - z.constant[i], high[i] - z.constant[i]))
            prices.append(price)

    for k in range(horizon):
        if k not in firsts:
            equation = us[k] + xs[k].times(K) - us[k - 1] - xs[k - 1].times(K)
            limit(equation, [mpf(0)] * nu, [mpf(0)] * nu, None)
            continue
        low, high = list(case["u_min"]), list(case["u_max"])
        if k == 0 and "u_step" in case:
            low = [max(a, u - s) for a, u, s in zip(low, u_last, case["u_step"])]
            high = [min(a, u + s) for a, u, s in zip(high, u_last, case["u_step"])]
        limit(us[k], low, high, None)
        if k > 0 and "u_step" in case:
            limit(us[k] - us[k - 1], [-s for s in case["u_step"]], case["u_step"], case["step_price"])
        for c, d, is_change, least, most, price in case["quantities"]:
            z = xs[k].times(c) + us[k].times(d)
            if is_change and k == 0:
                continue
            if is_change:
                z = z - xs[k - 1].times(c) - us[k - 1].times(d)
            if mp.norm(z.rows, 1) > 0:
                limit(z, [least], [most], price)

    soft = [i for i, price in enumerate(prices) if price]
    size = horizon * nu + len(soft)
    whole, gradient, rows = zeros(size), zeros(size, 1), zeros(len(limits), size)
    whole[: horizon * nu, : horizon * nu], gradient[: horizon * nu, 0] = H, g
    for i, (row, _, _) in enumerate(limits):
        rows[i, : horizon * nu] = row
    for e, i in enumerate(soft):
        whole[horizon * nu + e, horizon * nu + e] = 2 * prices[i]
        rows[i, horizon * nu + e] = 1

    def numbers(a, shape):
        return np.array([float(x) for x in a]).reshape(shape)

    low, high = ([limit[side] for limit in limits] for side in (1, 2))
    sense = np.array([5 if a == b else 0 for a, b in zip(low, high)], dtype=np.int32)
    _, _, status, info = daqp.solve(
        numbers(whole, (size, size)),
        numbers(gradient, size),
        numbers(rows, (len(limits), size)),
        np.clip(numbers(high, len(limits)), -1e30, 1e30),
        np.clip(numbers(low, len(limits)), -1e30, 1e30),
        sense,
        primal_tol=1e-11,
        eps_prox=0.0,
    )
    assert status == 1, status
    force = info["lam"]
    active = [i for i in range(len(limits)) if sense[i] or abs(force[i]) > 1e-12]
    saddle, right = zeros(size + len(active)), zeros(size + len(active), 1)
    saddle[:size, :size] = whole
    for i in range(size):
        right[i] = -gradient[i]
    for a, i in enumerate(active):
        right[size + a] = high[i] if force[i] > 0 else low[i]
        for j in range(size):
            saddle[size + a, j] = saddle[j, size + a] = rows[i, j]
    solution = lu_solve(saddle, right)
    z = rows * solution[:size, 0]
    assert all(a - mpf(10) ** -30 <= v <= b + mpf(10) ** -30 for a, v, b in zip(low, z, high))
    for a, i in enumerate(active):
        assert sense[i] or (solution[size + a] > 0) == (force[i] > 0)
    return [solution[i] for i in range(nu)], len(active) - int(np.count_nonzero(sense))


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
    case["X"], case["K"] = riccati(*(case[name] for name in "ABQRN"))
    random = Random(index)
    random.draw(1)
    print("    {")
    for n in range(STATES):  # from near to far
        x0 = matrix([mpf(random.number(scale) / 2 ** (n % 4)) for scale in case["scale"]])
        u_last = [mpf(random.number(8)) for _ in range(case["B"].cols)]
        u, active = optimum(case, x0, u_last)
        print("        {{%s}, %d}," % (", ".join("%.17g" % float(value) for value in u + [0] * (2 - len(u))), active))
    print("    },")
print("};\n\n}  // namespace design_test")
