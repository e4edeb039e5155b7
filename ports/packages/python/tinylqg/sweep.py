# SPDX-License-Identifier: MIT
"""The same design with other values, one result for each combination."""

from __future__ import annotations

import itertools
from typing import Any, NamedTuple, Optional

from .errors import DesignError, expected
from .progress import done
from .result import Result, array


class Point(NamedTuple):
    """One combination."""

    values: dict
    """By the keys of the sweep."""
    design: Any
    """The Design with these values."""
    result: Optional[Result]
    """What `design.solve()` gives; None where it cannot be designed."""
    error: Optional[str]
    """Why not."""


class Sweep(list):
    """A list of Point, the last key's values change fastest."""

    def column(self, path: str):
        """A number of each result, "loop.phase_margin_deg", "loop.rms.u[0]": an array, NaN where there is none."""
        return array([number_at(point.result, path) for point in self])

    def table(self, *paths: str) -> dict:
        """Columns by name, as pandas.DataFrame takes them: the values, and numbers of the results by their paths."""
        keys = self[0].values if self else ()
        return {**{key: [point.values[key] for point in self] for key in keys}, **{p: self.column(p) for p in paths}}


def number_at(result, path):
    """NaN where the result or the number is missing."""
    place = result
    for step in path.replace("[", ".").replace("]", "").split("."):
        try:
            place = place[int(step) if step.isdigit() else step]
        except (KeyError, IndexError, TypeError):
            return float("nan")
    return float("nan") if place is None else place


def solved(design):
    """Of a design, what a task gives back: its result, or why there is none."""
    try:
        return design.solve(), None
    except DesignError as error:
        return None, str(error)


def sweep(design, values, executor, progress) -> Sweep:
    if not values:
        raise DesignError("sweep: expected values to go through, as rho=[0.1, 1, 10], found none")
    for key, items in values.items():
        if isinstance(items, (str, bytes, dict)) or not hasattr(items, "__iter__"):
            raise expected(f"sweep: {key}", "a list of values", f"{type(items).__name__} {items!r}")
    combinations = [dict(zip(values, items)) for items in itertools.product(*map(list, values.values()))]
    designs = [design.replace(combination) for combination in combinations]
    results = done(solved, [(one,) for one in designs], executor, progress, design.name)
    return Sweep(Point(*parts, *result) for *parts, result in zip(combinations, designs, results))
