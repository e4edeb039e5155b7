# SPDX-License-Identifier: MIT
"""The optimum of a law with limits, found without anything of the design engine.

What is added to the law in each block of samples is unknown. The cost is summed sample by sample over the horizon, with
xᵀXx at its end, X by the Riccati equation. DAQP (D. Arnström, A. Bemporad, D. Axehill) finds which limits are active;
what follows from these is solved, and its conditions are checked, in the numbers that the matrices have: any that NumPy
can add and multiply, such as mpmath's.
"""

import daqp
import numpy as np

NEGLIGIBLE = 1e-12  # multipliers of DAQP, in a problem that is scaled


def eye(size, like):
    return np.array([[like.flat[0] * 0 + (i == j) for j in range(size)] for i in range(size)])


def solved(A, b):
    """A X = b by elimination with the largest pivot of each column."""
    rows, size = np.hstack([A, b]), len(A)
    for k in range(size):
        best = k + int(np.argmax(abs(rows[k:, k])))
        rows[[k, best]] = rows[[best, k]]
        rows[k] = rows[k] / rows[k, k]
        others = np.arange(size) != k
        rows[others] = rows[others] - np.outer(rows[others, k], rows[k])
    return rows[:, size:]


def riccati(A, B, Q, R, N):
    """X and K by doubling (E. K.-W. Chu, H.-Y. Fan, W.-W. Lin, C.-S. Wang 2004): each round squares the closed loop."""
    weighted = solved(R, np.hstack([B.T, N.T]))
    G, H, unit = B @ weighted[:, : len(A)], Q - N @ weighted[:, len(A) :], eye(len(A), A)
    a = A - B @ weighted[:, len(A) :]
    while True:
        both = solved(unit + G @ H, np.hstack([a, G]))
        step = a.T @ H @ both[:, : len(A)]
        G, a, H = G + a @ both[:, len(A) :] @ a.T, a @ both[:, : len(A)], H + step
        if not (abs(step).max() > 0) or abs(step).max() < abs(H).max() * type(A.flat[0])(2) ** -180:
            break
    H = (H + H.T) / 2
    return H, solved(R + B.T @ H @ B, B.T @ H @ A + N.T)


class Problem:
    """Of a case: A, B, Q, R, N; blocks, their lengths; u_min, u_max; u_step and its step_price, or none; quantities,
    each (c, d, is_change, low, high, price) of z = c x + d u or its change; Nx and Nu, where x and u go with r, or
    none; prices of all limits, one after the other, in place of those, or none.

    What the state is, is `given`: x, u[k−1], r. Unknown are v of each block, u = law + v, then the excess of each soft
    limit."""

    def __init__(self, case):
        self.case = case
        self.X, self.K = riccati(*(case[name] for name in "ABQRN"))
        self.nx, self.nu = case["B"].shape
        self.given = self.nx + self.nu + (case["Nx"].shape[1] if "Nx" in case else 0)
        self.limits = []  # (row over given and v, low, high, price or None)
        cost = self._look_ahead()
        if "prices" in case:
            self.limits = [(*limit[:3], price) for limit, price in zip(self.limits, case["prices"], strict=True)]
        soft = [i for i, limit in enumerate(self.limits) if limit[3] is not None]
        self.size = len(cost) - self.given + len(soft)
        zero = self.X.flat[0] * 0
        whole = np.full((self.given + self.size,) * 2, zero)
        whole[: len(cost), : len(cost)] = 2 * cost
        self.rows = np.array([np.concatenate([row, np.full(len(soft), zero)]) for row, *_ in self.limits])
        for e, i in enumerate(soft):
            whole[len(cost) + e, len(cost) + e] = 2 * self.limits[i][3]
            self.rows[i, len(cost) + e] = zero + 1
        self.H, self.gradient = whole[self.given :, self.given :], whole[self.given :, : self.given]
        self._eliminate()
        self._scale()

    # x and u minus where they go: rows over given and v.
    def _look_ahead(self):
        case, nx, nu = self.case, self.nx, self.nu
        width = self.given + len(case["blocks"]) * nu
        zero = case["A"].flat[0] * 0
        x, goal_x, goal_u = (np.full((n, width), zero) for n in (nx, nx, nu))
        x[:, :nx] = eye(nx, case["A"])
        if "Nx" in case:
            goal_x[:, nx + nu : self.given], goal_u[:, nx + nu : self.given] = case["Nx"], case["Nu"]
        weight = np.block([[case["Q"], case["N"]], [case["N"].T, case["R"]]])
        cost, before = np.full((width, width), zero), None
        for block, length in enumerate(case["blocks"]):
            for k in range(length):
                u = goal_u - self.K @ (x - goal_x)
                at = self.given + block * nu
                u[:, at : at + nu] = u[:, at : at + nu] + eye(nu, u)
                if k == 0:
                    self._limit(x, u, before)
                both = np.vstack([x - goal_x, u - goal_u])
                cost = cost + both.T @ weight @ both
                before = (x, u)
                x = case["A"] @ x + case["B"] @ u
        return cost + (x - goal_x).T @ self.X @ (x - goal_x)

    def _limit(self, x, u, before):
        case = self.case
        for i in range(self.nu):
            self.limits.append((u[i], case["u_min"][i], case["u_max"][i], None))
        if before is not None and "u_step" in case:
            for i, step in enumerate(case["u_step"]):
                self.limits.append((u[i] - before[1][i], -step, step, case["step_price"]))
        for c, d, is_change, low, high, price in case["quantities"]:
            if is_change and before is None:
                continue
            z = c @ x + d @ u
            if is_change:
                z = z - c @ before[0] - d @ before[1]
            if abs(z[self.given :]).max() > 0:
                self.limits.append((z, low, high, price))

    def _eliminate(self):
        """Unknowns and limited quantities without active limits, and how multipliers move them."""
        rows = self.rows[:, self.given :]
        both = solved(self.H, np.hstack([-self.gradient, rows.T]))
        self.free, self.moved = both[:, : self.given], both[:, self.given :]
        self.z_free, self.z_moved = rows @ self.free + self.rows[:, : self.given], rows @ self.moved

    def _scale(self):
        """For DAQP, in doubles: unknowns with a diagonal of 1, rows of length 1."""
        H, rows = (np.array(a, dtype=float) for a in (self.H, self.rows[:, self.given :]))
        unit = 1 / np.sqrt(np.diag(H))
        self.length = np.linalg.norm(rows * unit, axis=1)
        self.scaled = H * np.outer(unit, unit), np.ascontiguousarray(rows * unit / self.length[:, None]), unit

    def _guess(self, given, low, high):
        H, rows, unit = self.scaled
        offset = np.array(self.rows[:, : self.given] @ given, dtype=float)
        lower, upper = (
            np.clip((np.array(limit, dtype=float) - offset) / self.length, -1e30, 1e30) for limit in (low, high)
        )
        gradient = np.array(self.gradient @ given, dtype=float) * unit
        sense = np.zeros(len(low), dtype=np.int32)
        _, _, status, info = daqp.solve(H, gradient, rows, upper, lower, sense, primal_tol=1e-11, eps_prox=0.0)
        assert status == 1, status
        force = np.array(info["lam"])
        return {i: force[i] > 0 for i in np.flatnonzero(abs(force) > NEGLIGIBLE * abs(force).max())}

    def bounds(self, given):
        """Of all limits; those of u[0] narrowed by those of its change, as far as these agree."""
        low, high = ([limit[side] for limit in self.limits] for side in (1, 2))
        for i, step in enumerate(self.case.get("u_step", [])):
            last = given[self.nx + i]
            low[i], high[i] = (
                min(max(self.limits[i][1], last - step), self.limits[i][2]),
                max(min(self.limits[i][2], last + step), self.limits[i][1]),
            )
        return low, high

    def _at_limits(self, given, active, low, high):
        """The active limits, the multipliers with which these are met, and all limited quantities."""
        which = sorted(active)
        limits = np.array([(high if active[i] else low)[i] for i in which], dtype=self.X.dtype)
        force = solved(self.z_moved[np.ix_(which, which)], (limits - self.z_free[which] @ given)[:, None])[:, 0]
        return which, force, self.z_free @ given + self.z_moved[:, which] @ force

    def optimum(self, given, tolerance):
        """u of this sample and how many limits are active. The conditions hold to `tolerance`, a share of a range."""
        low, high = self.bounds(given)
        ranges = [max([abs(a) for a in (h - l, l, h) if abs(a) < 1e300]) for l, h in zip(low, high)]
        active = self._guess(given, low, high)
        for _ in range(100):  # until nothing is left of what doubles leave open
            which, force, z = self._at_limits(given, active, low, high)
            wrong = {i for i, f in zip(which, force) if (f > 0) == active[i]}
            beyond = [max(l - value, value - h) / size for l, h, value, size in zip(low, high, z, ranges)]
            worst = max((i for i in range(len(low)) if i not in active), key=lambda i: beyond[i], default=None)
            if wrong:
                active = {i: side for i, side in active.items() if i not in wrong}
            elif worst is not None and beyond[worst] > tolerance:
                active[worst] = z[worst] > high[worst]
            else:
                break
        else:
            raise ArithmeticError("the conditions of the optimum are not met")
        return list(z[: self.nu]), len(which)
