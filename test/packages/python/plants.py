# SPDX-License-Identifier: MIT
"""A plant as MATLAB's variables."""

import numpy
import scipy.io

import tinylqg

PLANT = {"A": [[0.0, 1], [0, -2]], "B": [[0.0], [3]], "C": [[1.0, 0]], "D": 0.0, "Ts": 0.0}
WEIGHTS = {"Q": numpy.diag([10, 0.1]), "R": 0.1, "W": numpy.eye(2), "V": 1e-5}


def cells(*texts):
    return numpy.array(texts, dtype=object).reshape(-1, 1)


def save(file, **variables):
    scipy.io.savemat(file, variables)


def assert_plant(file, **keys):
    """Whether `file` has the plant above, bit by bit; returns its [plant]."""
    found = tinylqg.read_mat(file, **keys)["plant"]
    for key in "ABCD":
        numpy.testing.assert_array_equal(found[key], numpy.atleast_2d(PLANT[key]), key)
    assert found["domain"] == "continuous"
    return found
