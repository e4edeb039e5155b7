# SPDX-License-Identifier: MIT
"""Many runs of a scenario, by `lqgen simulate`, here or in parts by an executor, and what they tell together."""

from __future__ import annotations

import math
from typing import Any, List, Optional

from .progress import done
from .quantile import chi_squared_quantile
from .result import Table, array
from .simulation import simulated, tables, whole, with_scenario

PERCENTS = (5, 50, 95)
SCALE = 2**20  # of the sums of NEES and NIS, which are whole numbers: sums of parts are the sum of all
SMALLEST_PART, SMALLEST_PART_HERE = 250, 1000  # runs: each part designs again
SUMS = ("nees", "nees_counts", "nis", "nis_counts")


class MonteCarlo:
    """What many runs of a scenario tell. Run i is the same whatever other runs are made beside it."""

    name: str
    """Of the scenario."""
    runs: int
    seed: int
    failed: float
    """Share of the runs that were lost, or missed what [require] asks of the scenario."""
    failures: Any
    """Of each run, whether it is one of those: an array of bool."""
    numbers: List[Table]
    """Of each run, as `Run.numbers`."""
    percentiles: dict
    """By 5, 50 and 95: a Table like `Run.numbers`. The number that so many percent of the runs do not exceed; infinite
    where it was not reached, as a settling time."""
    nees: Optional[Table]
    """eᵀ P⁻¹ e, whether the filter knows its error: mean over all, `expected`, its degrees of freedom; low and high,
    between which the mean over the runs lies in 95 % of the samples if it does; share_inside, of the samples in which
    it does. None without a filter that knows its error."""
    nis: Optional[Table]
    """νᵀ S⁻¹ ν of the innovations, likewise, of samples in which no output was left out."""

    def __init__(self, name, seed, parts):
        self.name, self.seed = name, seed
        self.numbers = [tables(numbers) for part in parts for numbers in part["samples"]]
        failures = [failed for part in parts for failed in part["failures"]]
        self.runs, self.failures = len(failures), array(failures)
        self.failed = sum(failures) / len(failures)
        self.percentiles = {percent: percentiles_of(self.numbers, percent) for percent in PERCENTS}
        sums = {key: joined(key, parts) for key in SUMS}
        for key in ("nees", "nis"):
            degrees = max(part["sums"][f"{key}_degrees"] for part in parts)
            setattr(self, key, consistency(sums[key], sums[f"{key}_counts"], degrees))

    def column(self, path: str):
        """A number of each run, as "steps[0].overshoot": an array; NaN where there is none."""
        from .sweep import number_at

        return array([number_at(numbers, path) for numbers in self.numbers])

    def __repr__(self):
        return f"<MonteCarlo {self.name}: {self.runs} runs, {self.failed:.2%} failed>"


def percentile(values, percent):
    """The nearest rank: the least that `percent` of the values do not exceed."""
    rank = max(1, math.ceil(percent / 100 * len(values)))
    return sorted(values)[rank - 1]


def percentiles_of(items, percent):
    """Of tables and lists of the same shape, number by number; a truth value is 0 or 1, None infinite."""
    first = items[0]
    if isinstance(first, dict):
        return Table({key: percentiles_of([item[key] for item in items], percent) for key in first})
    if isinstance(first, str):
        return first
    if hasattr(first, "__len__"):
        made = [percentiles_of(list(entries), percent) for entries in zip(*items)]
        return made if made and isinstance(made[0], dict) else array(made)
    return percentile([math.inf if value is None else float(value) for value in items], percent)


def joined(key, parts):
    """Sums of parts, sample by sample; a part whose runs were all lost may have fewer."""
    rows = [part["sums"][key] for part in parts]
    length = max(map(len, rows))
    return [sum(row[k] for row in rows if k < len(row)) for k in range(length)]


def consistency(sums, counts, degrees):
    """Means over the runs of `degrees` squares of normal numbers, against the bounds of 95 %."""
    most = max(counts, default=0)
    if most < 1 or degrees < 1:
        return None
    limits = {count: bounds(count, degrees) for count in set(counts) if count > 0}
    low, high = limits[most]
    means = [(total / SCALE / count, limits[count]) for total, count in zip(sums, counts) if count > 0]
    inside = sum(least <= mean <= largest for mean, (least, largest) in means)
    return Table(
        mean=sum(sums) / SCALE / sum(counts), expected=degrees, low=low, high=high, share_inside=inside / len(means)
    )


def bounds(count, degrees):
    return tuple(chi_squared_quantile(p, count * degrees) / count for p in (0.025, 0.975))


def part_of(design, name, seed, first, count):
    """Runs first … first + count − 1: what a task does."""
    words = [] if name is None else ["--scenario", name]
    said = simulated(design, "--seed", seed, "--runs", str(count), "--first", str(first), *words)
    return {key: said["monte_carlo"][0][key] for key in ("name", "samples", "failures", "sums")}


def monte_carlo(design, runs, seed, scenario, executor, progress) -> MonteCarlo:
    design, name = with_scenario(design, scenario)
    runs, seed = int(whole("runs", runs, 1)), whole("seed", seed, 0)
    smallest = SMALLEST_PART_HERE if executor is None else SMALLEST_PART
    size = runs if executor is None and progress is False else max(smallest, -(-runs // 64))
    tasks = [(design, name, seed, first, min(size, runs - first)) for first in range(0, runs, size)]
    parts = done(part_of, tasks, executor, progress, design.name)
    return MonteCarlo(parts[0]["name"], int(seed), parts)
