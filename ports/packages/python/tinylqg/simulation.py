# SPDX-License-Identifier: MIT
"""Runs of the emitted controller around its plant, as `lqgen simulate` makes them."""

from __future__ import annotations

import json
from typing import Any, Mapping

from .errors import expected, refusing
from .result import Table, array

SIGNALS = ("x", "estimate", "sigma", "y", "outputs", "u", "r", "innovation")
SERIES = ("t", "nis", "nees")
NAMES = {
    **dict.fromkeys(("x", "estimate", "sigma"), "states"),
    **dict.fromkeys(("y", "outputs", "innovation"), "outputs"),
    "u": "inputs",
    "r": "references",
}


class Run:
    """One run of a scenario. Arrays have a row for each of n samples; what a design does not have is None."""

    name: str
    """Of the scenario."""
    seed: int
    t: Any
    """n: s."""
    x: Any
    """n × nx: the plant's own states, in their units."""
    estimate: Any
    """n × nx: of them, as u was made of it; without a filter x itself."""
    sigma: Any
    """n × nx: standard deviation of the estimate's error that the design promises; None without noise."""
    y: Any
    """n × ny: as the controller was told; NaN where it was told nothing."""
    outputs: Any
    """n × ny: C x + D u without noise."""
    u: Any
    """n × nu: within the limits."""
    r: Any
    """n × nr: the references."""
    innovation: Any
    """n × ny: y − C x̂ − D u; None without a filter that keeps x̂."""
    nis: Any
    """n: νᵀ S⁻¹ ν of the innovation ν, of the outputs that were used."""
    nees: Any
    """n: eᵀ P⁻¹ e of the estimate's error e."""
    events: list
    """n sets of names, as "input_limited"."""
    numbers: Table
    """What decides: rms, peak, share_at_limits, steps (rise_time, settling_time, overshoot), left_out, resets, cost,
    diverged."""
    names: Table
    """states, inputs, outputs, references: what the columns are called, with units."""

    def __init__(self, names: Mapping, scenario: Mapping):
        self.names = Table(names)
        self.name, self.seed = scenario["name"], scenario["seed"]
        for key in SERIES:
            setattr(self, key, series(scenario.get(key)))
        for key in SIGNALS:
            setattr(self, key, rows(scenario.get(key), len(scenario["t"])))
        self.events = [frozenset() for _ in scenario["t"]]
        for sample in scenario.get("events", []):
            self.events[sample["k"]] = frozenset(sample["events"])
        self.numbers = tables(scenario["numbers"])

    def columns(self) -> dict:
        """All signals by name, as pandas.DataFrame(run.columns()) takes them: "t", "x angle [rad]", "u voltage [V]"."""
        found = {"t": self.t}
        for key in SIGNALS:
            matrix = getattr(self, key)
            if matrix is not None:
                for j, name in enumerate(self.names[NAMES[key]]):
                    found[f"{key} {name}"] = array([row[j] for row in matrix])
        for key in ("nis", "nees"):
            if getattr(self, key) is not None:
                found[key] = getattr(self, key)
        return found

    def __repr__(self):
        return f"<Run {self.name}: {len(self.t)} samples, seed {self.seed}>"


def tables(value):
    """Tables of numbers; null is None."""
    if isinstance(value, dict):
        return Table({key: tables(item) for key, item in value.items()})
    if isinstance(value, list):
        if all(isinstance(item, (int, float)) and not isinstance(item, bool) for item in value):
            return array(value)
        return [tables(item) for item in value]
    return value


def series(values):
    return None if values is None else array([float("nan") if value is None else value for value in values])


def rows(signals, count):
    """Signals as columns of `count` rows."""
    if signals is None:
        return None
    columns = [[float("nan") if value is None else value for value in signal] for signal in signals]
    return array([[column[k] for column in columns] for k in range(count)])


def with_scenario(design, scenario):
    """The design that has `scenario`, and that scenario's name, which lqgen checks; None: the first one there is. A
    dictionary takes the place of a scenario of its name."""
    if scenario is None:
        return design, design.scenarios[0] if design.scenarios else None
    if isinstance(scenario, str):
        return design, scenario
    if not isinstance(scenario, Mapping):
        raise expected("scenario", "a name or a dictionary", f"{type(scenario).__name__} {scenario!r}")
    scenario = {"name": "scenario", **scenario}
    others = [other for other in design.tables.get("scenario", []) if other.get("name") != scenario["name"]]
    return design.replace(scenario=[*others, scenario]), scenario["name"]  # [require] may name one of the others


def simulated(design, *arguments):
    """What `lqgen simulate --json` says."""
    text, _ = design.lqgen("simulate", "-", "--json", *arguments)
    with refusing(design.name, "the JSON text of lqgen simulate"):
        return json.loads(text)


def simulate(design, scenario, seed):
    design, name = with_scenario(design, scenario)
    words = [] if name is None else ["--scenario", name]
    said = simulated(design, "--seed", whole("seed", seed, 0), *words)
    names = {key: said[key] for key in ("states", "inputs", "outputs", "references")}
    return Run(names, said["scenarios"][0])


def whole(what, value, least):
    """A whole number as lqgen's command line has it."""
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise expected(what, "a whole number", f"{type(value).__name__} {value!r}")
    if value.__index__() < least:
        raise expected(what, f"at least {least}", value)
    return str(value.__index__())
