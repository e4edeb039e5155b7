# SPDX-License-Identifier: MIT
# Makes the numbers of test_transfer_recovery.cpp: python3 transfer_recovery_reference.py, with mpmath
# (https://mpmath.org). Nothing here is shared with the design engine: block exponentials (C. F. Van Loan, 1978),
# Riccati and Lyapunov recursions until they stand still, and the disk margin by a golden section on the unit circle,
# in 40 digits.
from mpmath import diag, expj, expm, eye, inverse, matrix, mp, mpf, pi, sqrt, zeros

mp.dps = 40


def block(rows):
    result = zeros(sum(row[0].rows for row in rows), sum(part.cols for part in rows[0]))
    top = 0
    for row in rows:
        left = 0
        for part in row:
            for i in range(part.rows):
                for j in range(part.cols):
                    result[top + i, left + j] = part[i, j]
            left += part.cols
        top += row[0].rows
    return result


def part(a, top, bottom, left, right):
    return matrix([[a[i, j] for j in range(left, right)] for i in range(top, bottom)])


def rest(step, start):
    now = start
    while True:
        after = step(now)
        if mp.norm(after - now) <= mpf(10) ** -36 * mp.norm(after):
            return after
        now = after


def exponential(a):
    return expm(a, method="taylor")


class Loop:
    """The plant sampled, its regulator, and its filter in filter form with recovery q, noise w as a density."""

    def __init__(self, A, B, C, G, Q, R, W, V, T):
        nx, nu = A.rows, B.cols
        self.C, self.V = C, V / T
        F = block([[A, B], [zeros(nu, nx + nu)]])
        weight = block([[Q, zeros(nx, nu)], [zeros(nu, nx), R]])
        n = nx + nu
        whole = exponential(block([[-F.T, weight], [zeros(n, n), F]]) * T)
        phi = part(whole, n, 2 * n, n, 2 * n)
        self.weight = phi.T * part(whole, 0, n, n, 2 * n)
        self.A, self.B = part(phi, 0, nx, 0, nx), part(phi, 0, nx, nx, n)
        whole = exponential(block([[-A, G * W * G.T], [zeros(nx, nx), A.T]]) * T)
        self.W = part(whole, nx, 2 * nx, nx, 2 * nx).T * part(whole, 0, nx, nx, 2 * nx)
        self.fictitious = self.B * self.B.T / T
        Q, N, R = (part(self.weight, *at) for at in ((0, nx, 0, nx), (0, nx, nx, n), (nx, n, nx, n)))

        def gain(X):
            return inverse(R + self.B.T * X * self.B) * (self.B.T * X * self.A + N.T)

        def step(X):
            K = gain(X)
            closed, law = self.A - self.B * K, block([[eye(nx)], [-K]])
            return closed.T * X * closed + law.T * self.weight * law

        self.K = gain(rest(step, Q))

    def recovered(self, q):
        A, B, C, V, K, nx = self.A, self.B, self.C, self.V, self.K, self.A.rows
        one = eye(nx)

        def gain(P):
            return P * C.T * inverse(C * P * C.T + V)

        def step(P):
            kept = one - gain(P) * C
            return A * (kept * P * kept.T + gain(P) * V * gain(P).T) * A.T + self.W + q * self.fictitious

        L = gain(rest(step, one))
        error = rest(lambda P: A * ((one - L * C) * P * (one - L * C).T + L * V * L.T) * A.T + self.W, one)
        # [x; x̂⁻]⁺ under w, v: u = −K (x̂⁻ + L (C x + v − C x̂⁻))
        KL = K * L
        closed = block([[A - B * KL * C, -B * (K - KL * C)], [(A - B * K) * L * C, (A - B * K) * (one - L * C)]])
        noise = block([[one, -B * KL], [zeros(nx, nx), (A - B * K) * L]])
        both = diag([1] * (nx + C.rows))
        for i in range(nx):
            for j in range(nx):
                both[i, j] = self.W[i, j]
        for i in range(C.rows):
            for j in range(C.rows):
                both[nx + i, nx + j] = V[i, j]
        states = rest(lambda S: closed * S * closed.T + noise * both * noise.T, eye(2 * nx))
        seen = block([[one, zeros(nx, nx)], [-KL * C, -(K - KL * C)]])
        direct = block([[zeros(nx, nx), zeros(nx, C.rows)], [zeros(B.cols, nx), -KL]])
        outputs = seen * states * seen.T + direct * both * direct.T
        cost = sum((self.weight * outputs)[i, i] for i in range(outputs.rows))
        return L, error, cost, self.disk(L)

    def disk(self, L):
        A, B, C, K, one = self.A, self.B, self.C, self.K, eye(self.A.rows)
        kept = one - L * C

        def size(angle):
            z = expj(angle)
            plant = C * inverse(z * one - A) * B
            filter = (K * kept * inverse(z * one - (A - B * K) * kept) * (A - B * K) * L + K * L) * plant
            return abs((1 - filter[0]) / (1 + filter[0])) / 2

        angles = [pi * mpf(10) ** (mpf(k) / 600 - 4) for k in range(2401)]
        with mp.workdps(15):
            best = max(range(1, 2400), key=lambda k: size(angles[k]))
        if size(0) >= size(angles[best]):
            return 1 / size(0)
        low, high, share = angles[best - 1], angles[best + 1], (sqrt(5) - 1) / 2
        for _ in range(150):
            a, b = high - share * (high - low), low + share * (high - low)
            low, high = (a, high) if size(a) < size(b) else (low, b)
        return 1 / size((low + high) / 2)


def show(name, loop, q):
    L, error, cost, disk = loop.recovered(mpf(q))
    numbers = list(L) + [error[i, j] for i in range(error.rows) for j in range(i + 1)] + [cost, disk]
    print(name, "q =", q, *(mp.nstr(x, 20) for x in numbers), sep="\n    ")


# J. C. Doyle, "Guaranteed margins for LQG regulators", IEEE Transactions on Automatic Control 23 (1978), 756-757, with
# q = σ = 60, sampled every 10 ms.
doyle = Loop(
    matrix([[1, 1], [0, 1]]),
    matrix([0, 1]),
    matrix([[1, 0]]),
    matrix([1, 1]),
    60 * matrix([[1, 1], [1, 1]]),
    matrix([[1]]),
    matrix([[60]]),
    matrix([[1]]),
    mpf(1) / 100,
)
for q in ("0", "11000"):
    show("Doyle", doyle, q)
oscillator = Loop(
    matrix([[0, 1], [-4, mpf(-1) / 2]]),
    matrix([0, 2]),
    matrix([[1, 0]]),
    matrix([0, 1]),
    matrix([[1, 0], [0, 0]]),
    matrix([[1]]) / 8,
    matrix([[1]]) / 4,
    matrix([[1]]) / 1024,
    mpf(1) / 8,
)
for q in ("0", "0.5"):
    show("oscillator", oscillator, q)
