# SPDX-License-Identifier: MIT
# Makes mpc_reference.h, the optima of the problems of limited.c by another solver: DAQP (D. Arnström, A. Bemporad,
# D. Axehill, https://github.com/darnstrom/daqp), over w and the excess of soft rows, not over multipliers.
#
#     pip install daqp==0.11.0 numpy && python3 mpc_reference.py >mpc_reference.h
import daqp
import numpy as np

BOX, RATES, SOFT, EQUAL_ROWS, NEARLY_SINGULAR, INFINITE, EQUAL_LIMITS, KINDS = range(8)
SEEDS = 40


class Random:
    """Knuth's MMIX generator"""

    def __init__(self, seed):
        self.state = seed

    def draw(self, most):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (self.state >> 33) % (most + 1)


def rows_of(kind, nu, nv, more):
    if kind in (BOX, INFINITE, EQUAL_LIMITS):
        return nv
    return 2 * nv - nu if kind == RATES else nv + more


def random_problem(kind, seed):
    random = Random(1000003 * seed + kind)
    random.draw(1)
    nu = 1 + random.draw(1)
    nv = nu + 1 + random.draw(5)
    rows = rows_of(kind, nu, nv, random.draw(nv))
    f, M, soft = np.zeros(rows), np.zeros((rows, nv)), np.zeros(rows)
    for i in range(rows):
        f[i] = (random.draw(128) - 64) / 16
        for j in range(nv):
            M[i, j] = (random.draw(32) - 16) / 16 + (2 if i == j else 0)
    for i in range(nv, rows):
        like = i - nv
        if kind == SOFT:
            soft[i] = 1 / 1024
        elif kind == RATES:
            soft[i], f[i], M[i] = 1 / 1048576, f[like + nu] - f[like], M[like + nu] - M[like]
        else:
            f[i], M[i] = f[like], M[like]
            M[i, 0] += 1 / 4096 if kind == NEARLY_SINGULAR else 0
    w = np.array([(random.draw(32) - 16) / 16 for _ in range(nv)])
    low, high = np.zeros(rows), np.zeros(rows)
    for i in range(rows):
        feasible, unit = f[i] + M[i] @ w, 0.25 if kind == RATES and i >= nv else 1
        low[i], high[i] = -unit * (1 + random.draw(16) / 16), unit * (1 + random.draw(16) / 16)
        choice = random.draw(3)
        if not soft[i]:
            low[i], high[i] = min(low[i], feasible), max(high[i], feasible)
        if kind == INFINITE:
            low[i] = -np.inf if choice % 2 else low[i]
            high[i] = np.inf if choice > 1 else high[i]
        if kind == EQUAL_LIMITS and choice == 0:
            low[i] = high[i] = feasible
        if kind == EQUAL_ROWS and i >= nv:
            low[i], high[i] = low[i - nv], high[i - nv]
    return nu, f, M, soft, low, high


def optimum(nu, f, M, soft, low, high):
    """w, e of the least wᵀw + Σ e²/soft with low ≤ f + M w + e ≤ high."""
    is_soft = np.flatnonzero(soft)
    nv, rows = M.shape[1], len(f)
    H = np.diag(np.concatenate([np.ones(nv), 1 / soft[is_soft]]))
    A = np.hstack([M, np.eye(rows)[:, is_soft]])
    bounds = [np.clip(limit - f, -1e30, 1e30) for limit in (high, low)]
    sense = np.zeros(rows, dtype=np.int32)
    solution, _, status, _ = daqp.solve(
        H, np.zeros(len(H)), np.ascontiguousarray(A), *bounds, sense, primal_tol=1e-12, zero_tol=1e-13, eps_prox=0.0
    )
    assert status == 1, status
    z = A @ solution
    assert np.all(z <= bounds[0] + 1e-11) and np.all(z >= bounds[1] - 1e-11)
    return f[:nu] + M[:nu] @ solution[:nv]


print("/* SPDX-License-Identifier: MIT */")
print(f"/* Made by mpc_reference.py: u of the problems of limited.c by DAQP {'0.11.0'}; 0 where there is no second. */")
print("static const double reference[KINDS][REFERENCES][MAX_U] = {")
for kind in range(KINDS):
    print("    {")
    for seed in range(SEEDS):
        u = list(optimum(*random_problem(kind, seed))) + [0.0]
        print(f"        {{{u[0]!r}, {u[1]!r}}},".replace("np.float64(", "").replace(")", ""))
    print("    },")
print("};")
