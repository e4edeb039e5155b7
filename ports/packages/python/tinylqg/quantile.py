# SPDX-License-Identifier: MIT
"""The quantile of a χ² distribution, for Pythons without scipy."""

import math

SMALLEST = 1e-15  # relative, of a term that still counts


def chi_squared_quantile(p, degrees):
    """x with P(χ² ≤ x) = p, 0 < p < 1, to some 12 digits: by bisection, as it is asked for a few times only."""
    low, high = 0.0, degrees + 10 * math.sqrt(2 * degrees) + 50
    for _ in range(200):
        x = (low + high) / 2
        if x in (low, high):
            break
        if regularised_gamma(degrees / 2, x / 2) < p:
            low = x
        else:
            high = x
    return (low + high) / 2


def regularised_gamma(a, x):
    """P(a, x) = γ(a, x)/Γ(a). DLMF 8.7.1 (series) below x = a + 1, 8.9.2 (continued fraction, by Lentz) above."""
    if x <= 0:
        return 0.0
    front = math.exp(a * math.log(x) - x - math.lgamma(a))
    if x < a + 1:
        term = total = 1 / a
        k = a
        while term > SMALLEST * total:
            k += 1
            term *= x / k
            total += term
        return front * total
    b = x + 1 - a
    c, d = math.inf, 1 / b
    fraction = d
    for i in range(1, 1000000):
        numerator = -i * (i - a)
        b += 2
        d = 1 / (numerator * d + b)
        c = b + numerator / c
        fraction *= d * c
        if abs(d * c - 1) < SMALLEST:
            break
    return 1 - front * fraction
