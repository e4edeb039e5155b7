# SPDX-License-Identifier: MIT
"""Transfer functions as minimal state spaces, and which states these have.

- One input and one output, no zeros: x = [y; ẏ; ÿ; …], named y, y_dot, y_dot2, …; of a discrete one x = [y[k]; y[k+1];
  …], named y, y_next, y_next2, …. Where D ≠ 0, y − D u stands in place of y, and the states have no names.
- One input and one output with zeros: the observable canonical form. With a₀ … the coefficients of the denominator
  below its highest, which is 1, and b₀ … those of the numerator of y − D u: x₀ = y − D u and
  x_{i+1} = ẋ_i + a_{n−1−i} x₀ − b_{n−1−i} u, in the discrete case with x_i[k+1] in place of ẋ_i.
- Several inputs or outputs: each entry so, one below the other, the entries of a row together. Where that is not
  minimal, states that no input reaches or no output shows are taken away by a change of coordinates, and x has no
  physical meaning: then weigh outputs (Q_output), not states.

A pole that a zero of the same entry cancels is taken away before.
"""

from .errors import DesignError, expected

SAME_ROOT = 1e-7  # relative to the root, or to 1: two of a polynomial's are known to half the digits
RANK = 1e-9  # of a direction, relative to the longest


def state_space(entries, is_discrete):
    """A, B, C, D, where there are any also names of the states, of ny × nu pairs (numerator, denominator), highest
    power first."""
    import numpy

    parts = [[entry_of(numpy, i, j, *entry) for j, entry in enumerate(row)] for i, row in enumerate(entries)]
    blocks = [part[0] for row in parts for part in row]
    order, nu = sum(len(block) for block in blocks), len(parts[0])
    if order == 0:
        raise expected("plant", "a transfer function with a pole", "a gain without any")
    A = numpy.zeros((order, order))
    B, C = numpy.zeros((order, nu)), numpy.zeros((len(parts), order))
    D = numpy.array([[part[3] for part in row] for row in parts])
    at = 0
    for i, row in enumerate(parts):
        for j, (block, b, c, _) in enumerate(row):
            there = slice(at, at + len(block))
            A[there, there], B[there, j], C[i, there] = block, b, c
            at += len(block)
    if len(blocks) > 1:
        A, B, C = reduced(numpy, A, B, C)
    matrices = {"A": A, "B": B, "C": C, "D": D}
    if len(blocks) == 1 and D[0, 0] == 0 and not B[:-1].any():
        matrices["states"] = names(order, "y_next" if is_discrete else "y_dot")
    return matrices


def names(order, word):
    return ["y", word, *(f"{word}{i}" for i in range(2, order))][:order]


def entry_of(numpy, i, j, numerator, denominator):
    """A, the only columns of B and Cᵀ, and the number D of one entry."""
    b, a = (numpy.trim_zeros(numpy.atleast_1d(numpy.asarray(p, dtype=float)), "f") for p in (numerator, denominator))
    if len(a) == 0:
        raise expected(f"plant: entry ({i}, {j})", "a denominator that is not 0", "0")
    if len(b) > len(a):
        raise DesignError(
            f"plant: entry ({i}, {j}): expected at most as many zeros as poles, {len(a) - 1}, found {len(b) - 1}"
        )
    b, a = without_common_roots(numpy, b / a[0], a / a[0])
    order = len(a) - 1
    b = numpy.concatenate([numpy.zeros(len(a) - len(b)), b])
    b, gain = b[1:] - b[0] * a[1:], b[0]
    if order == 0:
        return numpy.zeros((0, 0)), b, b, gain
    A = numpy.eye(order, k=1)
    first = numpy.eye(order)[0]
    if not b[:-1].any():
        A[-1] = 0 - a[:0:-1]
    else:
        A[:, 0] = 0 - a[1:]
    return A, b, first, gain


def without_common_roots(numpy, b, a):
    """Both polynomials without the roots that they share; what shares none keeps its coefficients."""
    if len(b) < 2:
        return b, a
    zeros, poles = list(numpy.roots(b)), []
    for pole in numpy.roots(a):
        near = [zero for zero in zeros if abs(zero - pole) <= SAME_ROOT * max(1, abs(pole))]
        if near:
            zeros.remove(min(near, key=lambda zero: abs(zero - pole)))
        else:
            poles.append(pole)
    if len(poles) == len(a) - 1:
        return b, a
    return tuple(numpy.atleast_1d(numpy.real(numpy.poly(roots))) * k for roots, k in ((zeros, b[0]), (poles, 1)))


def reduced(numpy, A, B, C):
    """Without what no input reaches, then without what no output shows; as it is where there is no such thing."""
    reached = span(numpy, A, B)
    if reached.shape[1] < len(A):
        A, B, C = reached.T @ A @ reached, reached.T @ B, C @ reached
    shown = span(numpy, A.T, C.T)
    if shown.shape[1] < len(A):
        A, B, C = shown.T @ A @ shown, shown.T @ B, C @ shown
    return A, B, C


def span(numpy, A, B):
    """An orthonormal basis of B, A B, A² B, …"""
    basis = numpy.zeros((len(A), 0))
    new = B
    while new.shape[1] > 0:
        for _ in range(2):  # the second time takes away what rounding has left
            new = new - basis @ (basis.T @ new)
        sizes = numpy.linalg.norm(B if basis.shape[1] == 0 else A, 2)
        directions, lengths, _ = numpy.linalg.svd(new, full_matrices=False)
        new = directions[:, lengths > RANK * max(sizes, numpy.finfo(float).tiny)]
        basis = numpy.hstack([basis, new])
        new = A @ new
    return basis
