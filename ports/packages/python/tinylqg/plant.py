# SPDX-License-Identifier: MIT
"""The [plant] of a design file, from what other tools call a system."""

import re
import sys

from .errors import DesignError, expected
from .toml import LARGEST_INTEGER
from .transfer import state_space

NO_SAMPLE_TIME = "the plant is continuous: expected sample_time=…, the loop's period in s"

SCALARS = {"domain": str, "sample_time": (int, float, str)}  # a text for a time is an expression


def plant_table(system, given):
    """The table of `system`; `given` has the caller's own keys of it, None where there is none."""
    if isinstance(system, dict):
        table = dict(system)
    elif isinstance(system, (tuple, list)):
        table = of_matrices(system, given.get("domain"))
    elif is_of_scipy(system):
        table = of_scipy(system)
    elif all(hasattr(system, key) for key in ("A", "B", "C", "D", "dt")) or all(
        hasattr(system, key) for key in ("num", "den", "dt")
    ):
        table = of_control(system)
    else:
        raise expected(
            "plant",
            "a state space or transfer function of python-control or scipy, (A, B, C, D), or a dictionary",
            f"{type(system).__module__}.{type(system).__name__}",
        )
    return complete(table, given)


def complete(table, given):
    table.update({key: scalar(key, table[key]) for key in SCALARS if table.get(key) is not None})
    for key, value in given.items():
        if value is None:
            continue
        if key in SCALARS:
            value = scalar(key, value)
        if key in SCALARS and table.get(key, value) != value:
            raise expected(f"plant.{key}", f"{table[key]!r}, as the plant says", repr(value))
        if key in ("G", "H", "delay") and table.get(key) is not None:
            raise DesignError(f"plant.{key}: given twice")
        table[key] = value
    if table.get("domain") is None:
        table["domain"] = "continuous"
    if table.get("sample_time") is None:
        raise DesignError(f"plant.sample_time: {NO_SAMPLE_TIME if table['domain'] == 'continuous' else 'missing'}")
    order = ("domain", "sample_time", "A", "B", "C", "D")
    return {**{key: table[key] for key in order if key in table}, **table}


def scalar(key, value):
    """A text for the domain, a number for a time; NumPy's and those of one entry as Python's."""
    if hasattr(value, "item") and getattr(value, "size", 1) == 1:
        value = value.item()
    if not isinstance(value, SCALARS[key]) or isinstance(value, bool):
        raise expected(f"plant.{key}", "a text" if key == "domain" else "a number", f"{type(value).__name__} {value!r}")
    if isinstance(value, int) and abs(value) > LARGEST_INTEGER:
        raise expected(f"plant.{key}", "a number", f"one of {value.bit_length()} bits")
    return value


def timed(matrices, dt):
    """`matrices` with the time base dt: 0 is continuous."""
    if dt is True:
        raise expected("plant.dt", "the sample time in s", "True, a discrete plant of unknown sample time")
    dt = scalar("sample_time", dt)
    if isinstance(dt, str):
        raise expected("plant.sample_time", "a number", repr(dt))
    if dt == 0:
        return {"domain": "continuous", **matrices}
    if not dt > 0:
        raise expected("plant.dt", "0 or the sample time in s", dt)
    return {"domain": "discrete", "sample_time": float(dt), **matrices}


def of_matrices(system, domain):
    """(A, B), (A, B, C), (A, B, C, D), or with a sample time behind, as scipy.signal.cont2discrete gives them."""
    if len(system) == 5:
        return timed(dict(zip("ABCD", map(two_dimensional, system))), system[4])
    if not 2 <= len(system) <= 4:
        raise expected("plant", "(A, B, C, D)", f"{len(system)} matrices")
    if domain is None:
        raise DesignError("plant.domain: matrices do not say it: expected domain=\"continuous\" or \"discrete\"")
    return {key: two_dimensional(matrix) for key, matrix in zip("ABCD", system) if matrix is not None}


def two_dimensional(matrix):
    """A matrix as it is, a number or an expression as 1 × 1, a number of NumPy, too."""
    if getattr(matrix, "ndim", None) == 0:
        matrix = matrix.item()
    return [[matrix]] if isinstance(matrix, (int, float, str)) and not isinstance(matrix, bool) else matrix


def is_of_scipy(system):
    signal = sys.modules.get("scipy.signal")
    return signal is not None and isinstance(system, (signal.lti, signal.dlti))


def of_scipy(system):
    """lti and dlti; zeros, poles and gains, and transfer functions, in the states of `transfer.py`."""
    dt = 0 if system.dt is None else system.dt
    if not hasattr(system, "A"):
        polynomials = system.to_tf()
        return timed(state_space([[(polynomials.num, polynomials.den)]], is_discrete=dt != 0), dt)
    return timed({key: getattr(system, key) for key in "ABCD"}, dt)


def of_control(system):
    """StateSpace or TransferFunction of python-control, with its labels where somebody has given some."""
    if system.dt is None:
        raise expected("plant.dt", "0 (continuous) or the sample time in s", "None, which leaves it open")
    if hasattr(system, "A"):
        matrices = {key: getattr(system, key) for key in "ABCD"}
    else:
        entries = [list(zip(*row)) for row in zip(*polynomials_of(system))]
        matrices = state_space(entries, is_discrete=system.dt != 0)
    for key, attribute in (("states", "state_labels"), ("inputs", "input_labels"), ("outputs", "output_labels")):
        labels = [label_of(text) for text in getattr(system, attribute, None) or []]
        if any(label != default for label, default in zip(labels, default_labels(key, len(labels)))):
            matrices[key] = labels
    return timed(matrices, system.dt)


def default_labels(key, count):
    letter = {"states": "x", "inputs": "u", "outputs": "y"}[key]
    return [f"{letter}_{i}" for i in range(count)]


def label_of(text):
    """python-control counts as in "sys[0]_x[1]", which C does not: sys_0_x_1."""
    return re.sub(r"\[(\d+)\]", r"_\1", text)


def polynomials_of(system):
    """Numerators and denominators, row by row; newer versions of python-control have lists by that name."""
    return [getattr(system, f"{key}_list", None) or getattr(system, key) for key in ("num", "den")]
