# SPDX-License-Identifier: MIT
# Makes the numbers of test_order.cpp: python3 order_reference.py, with mpmath (https://mpmath.org), NumPy and SciPy.
# Nothing here is shared with the design engine: compensators in companion form, so that no similarity is left; second
# moments by Kronecker products, averaged over the white parameters by Gauss-Hermite quadrature with three nodes (exact
# for normal parameters here); minima by the simplex method from 30 starts, then Newton's method with differences in 60
# digits.
import numpy as np
from mpmath import lu_solve, matrix, mp, mpf, nstr, sqrt
from scipy.optimize import minimize

mp.dps = 60


def solve(a, b):
    if a.dtype == float:
        return np.linalg.solve(a, b)
    return np.array([x for x in lu_solve(matrix(a.tolist()), matrix(b.tolist()))], dtype=object)


class Problem:
    """A plant with one input and one output, white parameters (A1, B1, C1), weights and noise of unit matrices."""

    def __init__(self, plant, whites=(), order=1, feedthrough=False, continuous=False):
        self.plant, self.whites = plant, whites
        self.order, self.feedthrough, self.continuous = order, feedthrough, continuous
        self.nx = len(plant[0])

    def parameters(self):
        return 2 * self.order + (1 if self.feedthrough else 0)

    # z+ = companion z + b y, u = first state + d y
    def compensator(self, theta):
        n, kind = self.order, type(theta[0])
        ac = np.array([[kind(1 if j == i + 1 else 0) for j in range(n)] for i in range(n)])
        ac[n - 1, :] = theta[n : 2 * n]
        bc = np.array(theta[:n]).reshape(n, 1)
        cc = np.array([[kind(1 if j == 0 else 0) for j in range(n)]])
        return ac, bc, cc, np.array([[theta[2 * n] if self.feedthrough else kind(0)]])

    # [xi+; u] = [phi noise; u d] [xi; w; v] at one value of the parameters
    def loop(self, theta, gammas):
        kind = type(theta[0])
        to = lambda m: np.array([[kind(x) for x in row] for row in m])
        a, b, c = map(to, self.plant)
        for white, gamma in zip(self.whites, gammas):
            a1, b1, c1 = map(to, white)
            a, b, c = a + gamma * a1, b + gamma * b1, c + gamma * c1
        ac, bc, cc, d = self.compensator(theta)
        phi = np.block([[a + b @ d @ c, b @ cc], [bc @ c, ac]])
        unit, none = to(np.eye(self.nx).tolist()), to(np.zeros((self.order, self.nx)).tolist())
        return phi, np.block([[unit, b @ d], [none, bc]]), np.block([[d @ c, cc]]), d

    def nodes(self, kind):
        grid, root = [((), kind(1))], kind(sqrt(3))
        rule = ((-root, kind(1) / 6), (kind(0), kind(2) / 3), (root, kind(1) / 6))
        for _ in self.whites:
            grid = [(g + (x,), w * share) for g, w in grid for x, share in rule]
        return grid

    def moments_and_cost(self, theta):
        n, kind = self.nx + self.order, type(theta[0])
        unit = np.array([[kind(i == j) for j in range(n)] for i in range(n)])
        if self.continuous:
            zero = [kind(0)] * len(self.whites)
            phi, noise, u, d = self.loop(theta, zero)
            system = -np.kron(phi, unit) - np.kron(unit, phi)
            for k in range(len(self.whites)):
                part = self.loop(theta, [kind(i == k) for i in range(len(zero))])[0] - phi
                system = system - np.kron(part, part)
            added, weight, direct = noise @ noise.T, u.T @ u, kind(0)
        else:
            system, added, weight, direct = np.kron(unit, unit), 0 * unit, 0 * unit, kind(0)
            for gammas, w in self.nodes(kind):
                phi, noise, u, d = self.loop(theta, gammas)
                system = system - w * np.kron(phi, phi)
                added, weight, direct = added + w * noise @ noise.T, weight + w * u.T @ u, direct + w * d[0, 0] ** 2
        weight[: self.nx, : self.nx] += unit[: self.nx, : self.nx]
        moments = solve(system, added.reshape(n * n)).reshape(n, n)
        return moments, np.trace(weight @ moments) + direct

    def rough_cost(self, theta):
        moments, cost = self.moments_and_cost([float(t) for t in theta])
        return cost if np.linalg.eigvalsh((moments + moments.T) / 2).min() > -1e-9 and 0 < cost < 1e6 else 1e6

    def minimum(self):
        draws, best = np.random.default_rng(1), None
        for _ in range(30):
            start = 0.5 * draws.standard_normal(self.parameters())
            options = {"maxfev": 1500, "xatol": 1e-9, "fatol": 1e-12}
            found = minimize(self.rough_cost, start, method="Nelder-Mead", options=options)
            best = found if best is None or found.fun < best.fun else best
        return self.polished([mpf(float(t)) for t in best.x])

    def polished(self, theta):
        k, step = len(theta), mpf(10) ** -15

        def at(*moves):
            moved = list(theta)
            for i, s in moves:
                moved[i] += s * step
            return self.moments_and_cost(moved)[1]

        for _ in range(12):
            g, h = matrix(k, 1), matrix(k, k)
            for i in range(k):
                g[i, 0] = (at((i, 1)) - at((i, -1))) / (2 * step)
                for j in range(i + 1):
                    ends = at((i, 1), (j, 1)) + at((i, -1), (j, -1)) - at((i, 1), (j, -1)) - at((i, -1), (j, 1))
                    h[i, j] = h[j, i] = ends / (4 * step * step)
            change = lu_solve(h, g)
            theta = [t - change[i] for i, t in enumerate(theta)]
            if max(abs(x) for x in change) < mpf(10) ** -28:
                break
        return self.moments_and_cost(theta)[1], theta


third_order = (
    [["1.1", "0.3", "0"], ["-0.3", "0.9", "0.2"], ["0", "0.1", "0.7"]],
    [["0"], ["0.5"], ["1"]],
    [["1", "0", "0.2"]],
)
second_order = ([["1.05", "0.2"], ["-0.1", "0.9"]], [["0.1"], ["1"]], [["1", "0"]])
moving = ([["-0.1", "1"], ["-1", "0.05"]], [["0"], ["1"]], [["1", "0"]])
whites = (
    ([["0", "0"], ["0", "0"]], [["0.02"], ["0.2"]], [["0.3", "0"]]),
    ([["0.1", "0"], ["0", "0.1"]], [["0"], ["0"]], [["0", "0"]]),
)

for name, problem in {
    "third order plant, order 1": Problem(third_order, order=1),
    "third order plant, order 2, feed-through": Problem(third_order, order=2, feedthrough=True),
    "white, order 1": Problem(second_order, whites=whites, order=1),
    "white, order 1, feed-through": Problem(second_order, whites=whites, order=1, feedthrough=True),
    "white, order 2": Problem(second_order, whites=whites, order=2),
    "continuous, order 1": Problem(moving, order=1, continuous=True),
    "continuous, white, order 2": Problem(moving, whites=whites, order=2, continuous=True),
}.items():
    cost, theta = problem.minimum()
    ac, bc, cc, d = problem.compensator(theta)
    print(f"{name}: cost {nstr(cost, 25)}; Markov parameters D, CB, CAB:", end=" ")
    print(", ".join(nstr(m[0, 0], 25) for m in (d, cc @ bc, cc @ ac @ bc)), flush=True)
