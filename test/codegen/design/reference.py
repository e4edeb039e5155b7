# SPDX-License-Identifier: MIT
# Makes the numbers of test_solve.cpp, test_augmentation.cpp, test_modal_plant.cpp and test_added_states.cpp:
# python3 reference.py, with mpmath (https://mpmath.org).
# Nothing here is shared with the design engine: matrix exponentials of whole blocks (C. F. Van Loan, 1978) and the
# stable eigenvectors of the symplectic matrix (D. R. Vaughan, 1970), in 120 digits; for the plant with a delay
# quadrature of the trajectory's cost, and the Riccati recursion until it stands still.
from mpmath import matrix, mp, mpf, eye, expm, quad, zeros

mp.dps = 120


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
    result = zeros(bottom - top, right - left)
    for i in range(top, bottom):
        for j in range(left, right):
            result[i - top, j - left] = a[i, j]
    return result


def sample(A, B, Q, R, T):
    nx, nz = A.rows, A.rows + B.cols
    F = block([[block([[A, B]])], [zeros(B.cols, nz)]])
    weight = block([[Q, zeros(nx, B.cols)], [zeros(B.cols, nx), R]])
    whole = expm(block([[-F.T, weight], [zeros(nz, nz), F]]) * T, method="taylor")
    phi = part(whole, nz, 2 * nz, nz, 2 * nz)
    cost = phi.T * part(whole, 0, nz, nz, 2 * nz)
    return (
        part(phi, 0, nx, 0, nx),
        part(phi, 0, nx, nx, nz),
        part(cost, 0, nx, 0, nx),
        part(cost, nx, nz, nx, nz),
        part(cost, 0, nx, nx, nz),
    )


def riccati(A, B, Q, R, N):
    nx = A.rows
    A0, G, H = A - B * R**-1 * N.T, B * R**-1 * B.T, Q - N * R**-1 * N.T
    back = (A0.T) ** -1
    values, vectors = mp.eig(block([[A0 + G * back * H, -G * back], [-back * H, back]]))
    stable = [k for k in range(2 * nx) if abs(values[k]) < 1]
    upper, lower = zeros(nx, nx), zeros(nx, nx)
    for column, k in enumerate(stable):
        for i in range(nx):
            upper[i, column], lower[i, column] = vectors[i, k], vectors[nx + i, k]
    X = (lower * upper**-1).apply(lambda z: z.real)
    return (X + X.T) / 2


def show(name, a):
    for i in range(a.rows):
        print(name, " ".join("%.17g" % float(a[i, j]) for j in range(a.cols)))


def double(rows):
    return matrix([[mpf(x) for x in row] for row in rows])


def two_mass():
    A = double([[0, 1, 0, 0], [-0.1, -0.004, 0.1, 0.004], [0, 0, 0, 1], [0.5, 0.02, -0.5, -0.02]])
    B, C = double([[0], [1], [0], [0]]), double([[1, 0, 0, 0], [0, 0, 1, 0]])
    W, V = mpf(0.01), mpf(0.001) * eye(2)
    A, B, Q, R, N = sample(A, B, mp.diag([1, 0, 1, 0]), double([[0.1]]), mpf(0.5))
    X = riccati(A, B, Q, R, N)
    show("K", (R + B.T * X * B) ** -1 * (B.T * X * A + N.T))
    P = riccati(A.T, C.T, B * B.T * W, V, zeros(4, 2))
    show("L", P * C.T * (C * P * C.T + V) ** -1)


# The cost of [x; held] over a time T, each entry by Gauss-Legendre quadrature.
def cost_by_quadrature(F, weight, T):
    nodes = {}

    def entry(i, j, t):
        if t not in nodes:
            moved = expm(F * t, method="taylor")
            nodes[t] = moved.T * weight * moved
        return nodes[t][i, j]

    n = F.rows
    result = zeros(n, n)
    for i in range(n):
        for j in range(i + 1):
            result[i, j] = result[j, i] = quad(lambda t: entry(i, j, t), [0, T])
    return result


# Two masses, 0.7 s late with a period of 0.5 s, with an integral of the first output and a weight on the change of u:
# z = [x; u[k-2]; u[k-1]; xi; u[k-1]], and for 0.2 s of a period u[k-2] acts, then u[k-1].
def two_mass_with_delay():
    mp.dps = 40
    A = double([[0, 1, 0, 0], [-0.1, -0.004, 0.1, 0.004], [0, 0, 0, 1], [0.5, 0.02, -0.5, -0.02]])
    T, late, S, Qi = mpf(0.5), mpf(0.7) - mpf(0.5), mpf(0.2), mpf(0.75)
    old, new = zeros(6, 6), zeros(6, 6)
    for i in range(4):
        for j in range(4):
            old[i, j] = new[i, j] = A[i, j]
    old[1, 4] = new[1, 5] = 1
    weight_old, weight_new = mp.diag([1, 0, 1, 0, mpf(0.1), 0]), mp.diag([1, 0, 1, 0, 0, mpf(0.1)])
    moved = expm(old * late, method="taylor")
    cost = cost_by_quadrature(old, weight_old, late)
    cost += moved.T * cost_by_quadrature(new, weight_new, T - late) * moved
    moved = expm(new * (T - late), method="taylor") * moved
    F, G, Q = zeros(8, 8), zeros(8, 1), zeros(8, 8)
    for i in range(4):
        for j in range(6):
            F[i, j] = moved[i, j]
    F[4, 5] = F[5, 7] = F[6, 6] = F[7, 7] = 1
    F[6, 0] = -T
    G[5] = G[7] = 1
    for i in range(6):
        for j in range(6):
            Q[i, j] = cost[i, j]
    Q[6, 6] = T * Qi
    X = eye(8)
    for _ in range(20000):
        K = (G.T * X * F) / (S + (G.T * X * G)[0])
        last, X = X, Q + F.T * X * (F - G * K)
        X = (X + X.T) / 2
        if mp.mnorm(X - last) < mpf(10) ** -30 * mp.mnorm(X):
            break
    show("K with delay", K)


# Three masses between walls in the coordinates of their modes: eigenvectors v, divided by the larger of their two
# outputs, give T = [re v, im v, ...].
def masses_between_walls():
    mp.dps = 60
    stiffness = [[-2.5, 1, 0], [1, -2, 1], [0, 1, -3]]
    A, B, C = zeros(6, 6), zeros(6, 1), zeros(2, 6)
    for i in range(3):
        A[i, 3 + i] = 1
        for j in range(3):
            A[3 + i, j], A[3 + i, 3 + j] = stiffness[i][j], mpf(0.01 * stiffness[i][j])
    B[3] = C[0, 0] = C[1, 2] = 1
    whole = expm(block([[block([[A, B]])], [zeros(1, 7)]]) * mpf(0.2), method="taylor")
    A, B = part(whole, 0, 6, 0, 6), part(whole, 0, 6, 6, 7)
    values, vectors = mp.eig(A)
    T = zeros(6, 6)
    upper = sorted((k for k in range(6) if values[k].imag > 0), key=lambda k: -abs(values[k]))
    for at, k in enumerate(upper):
        outputs = C * vectors[:, k]
        mode = vectors[:, k] / max(outputs, key=abs)
        for i in range(6):
            T[i, 2 * at], T[i, 2 * at + 1] = mode[i].real, mode[i].imag
    inverse = T**-1
    show("A of modes", inverse * A * T)
    show("B of modes", inverse * B)
    show("C of modes", C * T)
    show("variances of modes", matrix([(inverse * inverse.T)[i, i] for i in range(6)]))


# A motor whose input comes 0.15 s late with a period of 0.1 s, whose load torque wanders beside it by 0.25 a second's
# root, and whose angle is heard 0.2 s late, its speed at once: [x; d; angle[k-1]; angle[k-2]], then u[k-2], u[k-1].
# The filter's Riccati recursion until it stands still; for the law x, u[k-2], u[k-1], and at rest both are -d.
def late_and_disturbed_motor():
    mp.dps = 60
    T, late = mpf(0.1), mpf(0.15) - mpf(0.1)
    A, B = double([[0, 1], [0, -0.5]]), double([[0], [2]])
    F = block([[block([[A, B]])], [zeros(1, 3)]])
    noise = mp.diag([mpf(0.001), mpf(0.02), mpf(0.25) ** 2])
    whole = expm(block([[-F, noise], [zeros(3, 3), F.T]]) * T, method="taylor")
    phi = part(whole, 3, 6, 3, 6).T
    W = phi * part(whole, 0, 3, 3, 6)
    Fk, Wk = zeros(5, 5), zeros(5, 5)
    for i in range(3):
        for j in range(3):
            Fk[i, j], Wk[i, j] = phi[i, j], W[i, j]
    Fk[3, 0] = Fk[4, 3] = 1
    C = double([[0, 0, 0, 0, 1], [0, 1, 0, 0, 0]])
    V = mp.diag([mpf(1e-4), mpf(1e-3)]) / T
    P = eye(5)
    for _ in range(20000):
        last, S = P, C * P * C.T + V
        L = P * C.T * S**-1
        P = Fk * (P - L * S * L.T) * Fk.T + Wk
        P = (P + P.T) / 2
        if mp.mnorm(P - last) < mpf(10) ** -40 * mp.mnorm(P):
            break
    show("L late and disturbed", P * C.T * (C * P * C.T + V) ** -1)

    old, new = zeros(4, 4), zeros(4, 4)
    for i in range(2):
        for j in range(2):
            old[i, j] = new[i, j] = A[i, j]
    old[1, 2] = new[1, 3] = 2
    weight_old, weight_new = mp.diag([10, 1, mpf(0.5), 0]), mp.diag([10, 1, 0, mpf(0.5)])
    moved = expm(old * late, method="taylor")
    cost = cost_by_quadrature(old, weight_old, late)
    cost += moved.T * cost_by_quadrature(new, weight_new, T - late) * moved
    moved = expm(new * (T - late), method="taylor") * moved
    F, G = moved.copy(), zeros(4, 1)
    F[2, 2], F[2, 3], F[3, 3] = 0, 1, 0
    G[3] = 1
    X = eye(4)
    for _ in range(20000):
        K = (G.T * X * F) / (G.T * X * G)[0]
        last, X = X, cost + F.T * X * (F - G * K)
        X = (X + X.T) / 2
        if mp.mnorm(X - last) < mpf(10) ** -40 * mp.mnorm(X):
            break
    show("K late and disturbed", block([[part(K, 0, 1, 0, 2), matrix([[1 + K[2] + K[3]]]), part(K, 0, 1, 2, 4)]]))


two_mass()
two_mass_with_delay()
masses_between_walls()
late_and_disturbed_motor()
