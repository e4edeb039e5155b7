# SPDX-License-Identifier: MIT
"""The loop of a design over frequency, opened at the plant's inputs."""

from . import loop


def frequencies(result, points=2000):
    """rad/s, evenly on a logarithmic axis: four decades that end right before the Nyquist frequency π/T."""
    import numpy

    return numpy.geomspace(1e-4, 0.995, points) * numpy.pi / result.plant.sample_time


def transfer(numpy, matrices, z):
    """C (z I − A)⁻¹ B + D of each z: len(z) × rows of C × columns of B."""
    A, B, C, D = (numpy.asarray(matrix, dtype=complex) for matrix in matrices)
    resolvent = numpy.linalg.solve(z[:, None, None] * numpy.eye(len(A)) - A, numpy.broadcast_to(B, (len(z), *B.shape)))
    return C @ resolvent + D


def loop_gain(result, w):
    """L(e^{jwT}), len(w) × nu × nu, of the loop whose return difference is I + L: of the plant as the controller sees
    it and the controller, with r = 0 and without limits."""
    import numpy

    z = numpy.exp(1j * numpy.asarray(w) * result.plant.sample_time)
    plant, _ = loop.sensed(result)
    controller, _ = loop.controller(result, False)
    return -transfer(numpy, controller, z) @ transfer(numpy, plant, z)


def one_at_a_time(L):
    """len(w) × nu: what input i sees when all other loops are closed, 1/[(I + L)⁻¹]_ii − 1."""
    import numpy

    sensitivity = numpy.linalg.inv(numpy.eye(L.shape[1]) + L)
    return 1 / numpy.diagonal(sensitivity, axis1=1, axis2=2) - 1
